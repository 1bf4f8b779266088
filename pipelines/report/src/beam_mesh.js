// One beam as instanced segments: each instance is one rational cubic, evaluated in the vertex shader.
import {
  BufferAttribute, DoubleSide, DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry,
  InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh, RawShaderMaterial,
} from 'three';

const vertex_shader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 pixels;   // of the picture
uniform float width;   // of the line [pixels]
in vec2 place;         // u in [0, 1], side -1 or 1
in vec3 p0, p1, p2, p3;
#ifdef RATIONAL
in vec4 weights;
#endif
#ifdef COLOURED
in vec4 values;        // of the field at u = 0, 1/3, 2/3, 1
out float value;
#endif
out float side;

void main() {
  float u = place.x, v = 1.0 - u;
  vec4 b = vec4(v * v * v, 3.0 * u * v * v, 3.0 * u * u * v, u * u * u);
  vec4 db = 3.0 * vec4(-v * v, v * v - 2.0 * u * v, 2.0 * u * v - u * u, u * u);
#ifdef RATIONAL
  b *= weights;
  db *= weights;
#endif
  // r = N / W, r' = (N' - W' r) / W
  float w = dot(b, vec4(1.0)), dw = dot(db, vec4(1.0));
  vec3 r = (b.x * p0 + b.y * p1 + b.z * p2 + b.w * p3) / w;
  vec3 dr = (db.x * p0 + db.y * p1 + db.z * p2 + db.w * p3 - dw * r) / w;
  vec4 clip = projectionMatrix * modelViewMatrix * vec4(r, 1.0);
  vec2 along = (projectionMatrix * modelViewMatrix * vec4(dr, 0.0)).xy * pixels;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  clip.xy += place.y * width * vec2(-along.y, along.x) / pixels;
  gl_Position = clip;
  side = place.y;
#ifdef COLOURED
  float t = 3.0 * u;
  value = t < 1.0 ? mix(values.x, values.y, t) : t < 2.0 ? mix(values.y, values.z, t - 1.0)
                                                         : mix(values.z, values.w, t - 2.0);
#endif
}`;

const fragment_shader = /* glsl */ `
precision highp float;
in float side;
out vec4 colour;
#ifdef COLOURED
uniform sampler2D map;
uniform vec2 range;    // of the map, in parts of the field's range: its low end and its extent
uniform vec3 outline;  // tells the ends of the map from the background
in float value;
#else
uniform vec3 plain;
#endif

void main() {
#ifdef COLOURED
  // The middle of the first and last texel are the ends of the map.
  float part = clamp((value - range.x) / range.y, 0.0, 1.0);
  vec3 rgb = texture(map, vec2((0.5 + 255.0 * part) / 256.0, 0.5)).rgb;
  float light = sqrt(max(0.0, 1.0 - side * side));  // of a round bar lit from the viewer
  rgb *= mix(0.7, 1.0, light);
  colour = vec4(mix(outline, rgb, smoothstep(1.0, 0.6, abs(side))), 1.0);
#else
  colour = vec4(plain, 1.0);
#endif
}`;

/** Pieces of an element: enough to look smooth, a multiple of three (where the field's values sit). */
function pieces_of(element_count) {
  return element_count > 400 ? 6 : element_count > 100 ? 12 : element_count > 20 ? 24 : 60;
}

export class BeamMesh {
  /** A mesh of at most `most_elements`; it is coloured by a field if uniforms has a `map`, else plain. */
  constructor(most_elements, rational, uniforms) {
    const pieces = pieces_of(most_elements);
    const place = new Float32Array(4 * (pieces + 1));
    const index = [];
    for (let i = 0; i <= pieces; ++i) {
      place.set([i / pieces, -1, i / pieces, 1], 4 * i);
      if (i > 0) {
        index.push(2 * i - 2, 2 * i - 1, 2 * i, 2 * i, 2 * i - 1, 2 * i + 1);
      }
    }
    this.geometry = new InstancedBufferGeometry();
    this.geometry.setIndex(index);
    this.geometry.setAttribute('place', new BufferAttribute(place, 2));
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
    if (uniforms.map) {
      this.values = new InstancedBufferAttribute(new Uint16Array(4 * most_elements), 4, true);
      this.values.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute('values', this.values);
      defines.COLOURED = '';
    }
    this.object = new Mesh(this.geometry, new RawShaderMaterial({
      vertexShader: vertex_shader, fragmentShader: fragment_shader, glslVersion: GLSL3, defines, uniforms,
      side: DoubleSide,
    }));
    this.object.frustumCulled = false;
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
    if (this.values) {
      copy(this.values.array, shapes.shorts, shapes.field_start(frame, beam, field), 4 * n);
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
