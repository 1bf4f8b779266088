// One beam as a line of a width in pixels.
import { BufferAttribute } from 'three';
import { BeamInstances, instance_glsl, pieces_of } from './beam_instances.js';

const vertex_shader = instance_glsl + /* glsl */ `
uniform vec2 pixels;   // of the picture
uniform float width;   // of the line [pixels]
in vec2 place;         // u in [0, 1], side -1 or 1
out float side;

void main() {
  vec3 r, dr;
  curve_at(place.x, r, dr);
  vec4 clip = projectionMatrix * modelViewMatrix * vec4(r, 1.0);
  vec2 along = (projectionMatrix * modelViewMatrix * vec4(dr, 0.0)).xy * pixels;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  clip.xy += place.y * width * vec2(-along.y, along.x) / pixels;
  gl_Position = clip;
  side = place.y;
  set_value(place.x);
}`;

const fragment_shader = /* glsl */ `
precision highp float;
in float side;
out vec4 colour;
#ifdef COLOURED
uniform sampler2D map;
uniform vec3 outline;  // tells the ends of the map from the background
in float value;
#else
uniform vec3 plain;
#endif

void main() {
#ifdef COLOURED
  // The middle of the first and last texel are the ends of the map.
  vec3 rgb = texture(map, vec2((0.5 + 255.0 * value) / 256.0, 0.5)).rgb;
  float light = sqrt(max(0.0, 1.0 - side * side));  // of a round bar lit from the viewer
  rgb *= mix(0.7, 1.0, light);
  colour = vec4(mix(outline, rgb, smoothstep(1.0, 0.6, abs(side))), 1.0);
#else
  colour = vec4(plain, 1.0);
#endif
}`;

export class BeamMesh extends BeamInstances {
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
    super(most_elements, rational, false, {
      index, attributes: { place: new BufferAttribute(place, 2) }, vertexShader: vertex_shader,
      fragmentShader: fragment_shader,
    }, uniforms);
  }
}
