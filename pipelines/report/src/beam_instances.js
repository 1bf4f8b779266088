// What is instanced along a beam: each instance is one rational cubic, evaluated in the vertex shader.
import {
  DoubleSide, DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, InstancedInterleavedBuffer,
  InterleavedBufferAttribute, Mesh, RawShaderMaterial, Vector2,
} from 'three';

/** GLSL: r and its derivative dr at u of the instance, and the field's value there. */
export const instance_glsl = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 p0, p1, p2, p3;
#ifdef RATIONAL
in vec4 weights;
#endif
#ifdef COLOURED
in vec4 values;        // of the field at u = 0, 1/3, 2/3, 1
uniform vec2 range;     // from the beam's range to that of the map: factor and offset
out float value;
#endif

void curve_at(float u, out vec3 r, out vec3 dr) {
  float v = 1.0 - u;
  vec4 b = vec4(v * v * v, 3.0 * u * v * v, 3.0 * u * u * v, u * u * u);
  vec4 db = 3.0 * vec4(-v * v, v * v - 2.0 * u * v, 2.0 * u * v - u * u, u * u);
#ifdef RATIONAL
  b *= weights;
  db *= weights;
#endif
  // r = N / W, r' = (N' - W' r) / W
  float w = dot(b, vec4(1.0)), dw = dot(db, vec4(1.0));
  r = (b.x * p0 + b.y * p1 + b.z * p2 + b.w * p3) / w;
  dr = (db.x * p0 + db.y * p1 + db.z * p2 + db.w * p3 - dw * r) / w;
}

void set_value(float u) {
#ifdef COLOURED
  float t = 3.0 * u;
  value = t < 1.0 ? mix(values.x, values.y, t) : t < 2.0 ? mix(values.y, values.z, t - 1.0)
                                                         : mix(values.z, values.w, t - 2.0);
  value = range.x * value + range.y;
#endif
}`;

/** Pieces of an element: enough to look smooth, a multiple of three (where the field's values sit). */
export function pieces_of(element_count) {
  return element_count > 400 ? 6 : element_count > 100 ? 12 : element_count > 20 ? 24 : 60;
}

export class BeamInstances {
  /** At most `most_elements`, of vertices with these attributes; coloured by a field if uniforms has a `map`. */
  constructor(most_elements, rational, sections, { index, attributes, vertexShader, fragmentShader }, uniforms) {
    this.geometry = new InstancedBufferGeometry();
    this.geometry.setIndex(index);
    for (const [name, attribute] of Object.entries(attributes)) {
      this.geometry.setAttribute(name, attribute);
    }
    // Instance i starts at point 3 i and ends at point 3 i + 3, where the next one starts.
    this.points = new InstancedInterleavedBuffer(new Float32Array(9 * (most_elements + 1)), 9);
    this.points.setUsage(DynamicDrawUsage);
    for (let k = 0; k < 4; ++k) {
      this.geometry.setAttribute('p' + k, new InterleavedBufferAttribute(this.points, 3, 3 * k));
    }
    const defines = {};
    if (rational) {
      this.weights = new InstancedBufferAttribute(new Float32Array(4 * most_elements), 4).setUsage(DynamicDrawUsage);
      this.geometry.setAttribute('weights', this.weights);
      defines.RATIONAL = '';
    }
    if (sections) {
      this.axes = new InstancedInterleavedBuffer(new Float32Array(12 * most_elements), 12).setUsage(DynamicDrawUsage);
      for (let k = 0; k < 4; ++k) {
        this.geometry.setAttribute('a' + k, new InterleavedBufferAttribute(this.axes, 3, 3 * k));
      }
    }
    if (uniforms.map) {
      this.values = new InstancedBufferAttribute(new Uint8Array(4 * most_elements), 4, true);
      this.values.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute('values', this.values);
      defines.COLOURED = '';
    }
    this.range = { value: new Vector2(1, 0) };
    this.object = new Mesh(this.geometry, new RawShaderMaterial({
      vertexShader, fragmentShader, glslVersion: GLSL3, defines, uniforms: { ...uniforms, range: this.range },
      side: DoubleSide,
    }));
    this.object.frustumCulled = false;
  }

  /** Colours values, of which the beam has them from min to max, by a map from low to high. */
  set_range({ min, max }, { low, high }) {
    const extent = high > low ? high - low : 1;
    this.range.value.set((max - min) / extent, (min - low) / extent);
  }

  /** Takes the shape of a beam, and the field's values, from the loaded frame. */
  load(shapes, frame, beam, field) {
    const n = shapes.count(frame, beam);
    copy(this.points.array, shapes.floats, shapes.points_start(beam), 3 * (3 * n + 1));
    this.points.needsUpdate = true;
    if (this.weights) {
      copy(this.weights.array, shapes.floats, shapes.weights_start(frame, beam), 4 * n);
      this.weights.needsUpdate = true;
    }
    if (this.axes) {
      copy(this.axes.array, shapes.floats, shapes.axes_start(frame, beam), 12 * n);
      this.axes.needsUpdate = true;
    }
    if (this.values) {
      copy(this.values.array, shapes.bytes, shapes.field_start(frame, beam, field), 4 * n);
      this.values.needsUpdate = true;
    }
    this.geometry.instanceCount = n;
  }
}

/** Like set(subarray()), but makes no object. */
function copy(to, from, start, count) {
  for (let i = 0; i < count; ++i) {
    to[i] = from[start + i];
  }
}
