// One beam as the solid that its real section sweeps, so that its twist is seen.
import { BufferAttribute, ShapeUtils, Vector2 } from 'three';
import { BeamInstances, instance_glsl, pieces_of } from './beam_instances.js';

const vertex_shader = instance_glsl + /* glsl */ `
uniform float enlarged;
uniform int last;      // instance
in vec3 place;         // u in [0, 1], (x, y) in the section [m]
in vec3 outward;       // the normal along the section's axes and the tangent
in vec3 a0, a1, a2, a3;  // the section's x axis at u = 0, 1/3, 2/3, 1
out vec3 normal;       // as the viewer sees it

void main() {
  vec3 r, dr;
  curve_at(place.x, r, dr);
  float t = 3.0 * place.x;
  vec3 d1 = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0 * a0 + t * (t - 2.0) * (t - 3.0) / 2.0 * a1
    - t * (t - 1.0) * (t - 3.0) / 2.0 * a2 + t * (t - 1.0) * (t - 2.0) / 6.0 * a3;
  vec3 tangent = normalize(dr);
  d1 = normalize(d1 - dot(d1, tangent) * tangent);
  vec3 d2 = cross(tangent, d1);
  // Between elements there is no end.
  bool inner = outward.z < 0.0 ? gl_InstanceID > 0 : outward.z > 0.0 && gl_InstanceID < last;
  vec3 p = inner ? r : r + enlarged * (place.y * d1 + place.z * d2);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0);
  normal = mat3(modelViewMatrix) * (outward.x * d1 + outward.y * d2 + outward.z * tangent);
  set_value(place.x);
}`;

const fragment_shader = /* glsl */ `
precision highp float;
uniform sampler2D map;
in vec3 normal;
in float value;
out vec4 colour;

void main() {
  // The middle of the first and last texel are the ends of the map.
  vec3 rgb = texture(map, vec2((0.5 + 255.0 * value) / 256.0, 0.5)).rgb;
  vec3 n = normalize(normal) * (gl_FrontFacing ? 1.0 : -1.0);
  float light = max(0.0, dot(n, normalize(vec3(-0.3, 0.6, 0.9))));
  colour = vec4(rgb * mix(0.45, 1.0, light), 1.0);
}`;

/** Sides of a closed polygon with their normals at both ends: smooth where it turns little. */
function sides_of(polygon) {
  const n = polygon.length;
  const normals = polygon.map(([x, y], i) => {
    const [to_x, to_y] = polygon[(i + 1) % n];
    return new Vector2(to_y - y, x - to_x).normalize();
  });
  const between = (i, other) => (normals[i].dot(normals[other]) > 0.85
    ? normals[i].clone().add(normals[other]).normalize() : normals[i]);
  return polygon.map((from, i) => ({
    from, to: polygon[(i + 1) % n], from_normal: between(i, (i + n - 1) % n), to_normal: between(i, (i + 1) % n),
  }));
}

/** The vertices of one element: its walls, and the section at both ends. */
function vertices_of(outline, pieces) {
  const place = [], outward = [], index = [];
  const add = (u, [x, y], normal) => {
    place.push(u, x, y);
    outward.push(...normal);
    return place.length / 3 - 1;
  };
  for (const { from, to, from_normal, to_normal } of outline.flatMap(sides_of)) {
    for (let i = 0; i <= pieces; ++i) {
      const a = add(i / pieces, from, [from_normal.x, from_normal.y, 0]);
      add(i / pieces, to, [to_normal.x, to_normal.y, 0]);
      if (i > 0) {
        index.push(a - 2, a - 1, a, a, a - 1, a + 1);
      }
    }
  }
  const [contour, ...holes] = outline.map((polygon) => polygon.map(([x, y]) => new Vector2(x, y)));
  const triangles = ShapeUtils.triangulateShape(contour, holes);
  for (const u of [0, 1]) {
    const first = place.length / 3;
    outline.flat().forEach((point) => add(u, point, [0, 0, 2 * u - 1]));
    for (const [a, b, c] of triangles) {
      // Anticlockwise as seen from outside.
      index.push(first + a, first + (u ? b : c), first + (u ? c : b));
    }
  }
  return { place: new Float32Array(place), outward: new Float32Array(outward), index };
}

/** The largest distance of a section's outline from its centroid [m]. */
const size_of = (outline) => Math.max(...outline.flat().map(([x, y]) => Math.hypot(x, y)));

export class SectionMesh extends BeamInstances {
  constructor(most_elements, rational, outline, map) {
    const { place, outward, index } = vertices_of(outline, Math.min(pieces_of(most_elements), 12));
    const enlarged = { value: 1 }, last = { value: 0 };
    super(most_elements, rational, true, {
      index,
      attributes: { place: new BufferAttribute(place, 3), outward: new BufferAttribute(outward, 3) },
      vertexShader: vertex_shader,
      fragmentShader: fragment_shader,
    }, { map, enlarged, last });
    this.enlarged = enlarged;
    this.last = last;
    this.size = size_of(outline);
  }

  load(shapes, frame, beam, field) {
    super.load(shapes, frame, beam, field);
    this.last.value = shapes.count(frame, beam) - 1;
  }

  /** Enlarges the section to `least` pixels where it would be smaller; the factor. */
  enlarge_to(least, pixels_per_metre) {
    this.enlarged.value = Math.max(1, least / (2 * this.size * pixels_per_metre));
    return this.enlarged.value;
  }
}
