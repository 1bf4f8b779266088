// The 3-D picture: beams, bodies, supports, grid and signs of scale and direction. It is drawn only when it changes.
import {
  AmbientLight, BoxGeometry, BufferAttribute, BufferGeometry, Color, ConeGeometry, DataTexture, DirectionalLight,
  Group, Line, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, OctahedronGeometry, Points,
  PointsMaterial, Quaternion, Scene, SphereGeometry, SRGBColorSpace, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { BeamMesh } from './beam_mesh.js';
import { Boxes, with_room } from './boxes.js';
import { SectionMesh } from './section_mesh.js';
import { ViewCamera, steer, view_directions } from './camera.js';
import { field_colours } from './colours.js';
import { Connectors } from './connectors.js';
import { round_down } from './format.js';
import { raised, raising_matrix, suited_heights } from './heights.js';
import { LoadArrows } from './loads.js';
import { Overlay } from './overlay.js';

const y_axis = new Vector3(0, 1, 0);

/** The corners of a box, relative to the origin of the shapes. */
function corners([low, high], origin) {
  const points = [];
  for (let i = 0; i < 8; ++i) {
    points.push(new Vector3(...[0, 1, 2].map((k) => ((i >> k) & 1 ? high : low)[k] - origin[k])));
  }
  return points;
}

/** Lines every `step` metres over the points' shadow on the plane of directions a and b through `base`. */
function grid_lines(points, a, b, base, step) {
  const bounds = (d) => {
    const along = points.map((p) => p.dot(d));
    return [Math.floor(Math.min(...along) / step - 0.75), Math.ceil(Math.max(...along) / step + 0.75)];
  };
  const [a0, a1] = bounds(a), [b0, b1] = bounds(b);
  const ends = [];
  const add = (i, j) => {
    const p = base.clone().addScaledVector(a, i * step).addScaledVector(b, j * step);
    ends.push(p.x, p.y, p.z);
  };
  for (let i = a0; i <= a1; ++i) { add(i, b0); add(i, b1); }
  for (let j = b0; j <= b1; ++j) { add(a0, j); add(a1, j); }
  return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(ends), 3));
}

export class View {
  constructor(canvas, overlay, data) {
    this.canvas = canvas;
    this.data = data;
    this.frame = 0;
    this.field = 0;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new Scene();
    const model = data.run?.model;
    const plane_normal = model?.plane_normal ?? flat_direction(data.box);
    this.directions = view_directions(model?.['gravity [m/s^2]'], plane_normal);
    this.planar = Boolean(plane_normal);
    this.box_points = corners(with_room(data.box, data), data.shapes.origin);
    this.view = new ViewCamera(this.directions, this.box_points);
    this.uniforms = {
      pixels: { value: new Vector2(1, 1) },
      width: { value: 1 },
      map: { value: this.map_texture() },
      outline: { value: [0, 0, 0] },
    };
    this.heights = 1;  // are shown times this, from the middle of the model on
    this.pinned_size = [];  // objects drawn in pixels: their scale follows the zoom
    this.add_light();
    this.add_grid();
    this.add_beams();
    this.add_supports(model?.supports ?? []);
    this.add_points();
    this.connectors = new Connectors(data, (place) => this.placed(place));
    this.scene.add(this.connectors.object);
    this.loads = new LoadArrows(model?.loads ?? [], data, (symbol) => this.pinned_size.push(symbol), (place) => this.placed(place));
    this.scene.add(this.loads.object);
    this.overlay = new Overlay(overlay, this.points, model?.['gravity [m/s^2]'], this.grid_step);
    steer(canvas, this.view, () => this.moved());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.view.set_view(this.planar ? 'front' : 'iso');
    this.is_fitted = true;  // and stays so when the window changes, until the reader moves the camera
    this.resize();
    this.set_scheme();
  }

  map_texture() {
    const texture = new DataTexture(new Uint8Array(4 * 256), 256, 1);
    texture.magFilter = texture.minFilter = 1006;  // linear
    return texture;
  }

  add_light() {
    this.light = new DirectionalLight(0xffffff, 2.2);
    this.scene.add(new AmbientLight(0xffffff, 1.4), this.light, this.light.target);
  }

  add_grid() {
    const { up, front } = this.directions;
    const right = up.clone().cross(front);
    const size = Math.max(...[right, up, front].map((d) => {
      const along = this.box_points.map((p) => p.dot(d));
      return Math.max(...along) - Math.min(...along);
    })) || 1;
    this.grid_step = round_down(size / 6);
    const second = this.planar ? up : front;
    const normal = this.planar ? front : up;
    const lowest = Math.min(...this.box_points.map((p) => p.dot(normal)));
    const base = normal.clone().multiplyScalar(this.planar ? lowest : lowest - 0.5 * this.grid_step);
    this.grid_material = new LineBasicMaterial();
    this.grid = new LineSegments(grid_lines(this.box_points, right, second, base, this.grid_step), this.grid_material);
    this.grid.renderOrder = -2;
    this.scene.add(this.grid);
  }

  add_beams() {
    const { shapes } = this.data;
    const ghost = { pixels: this.uniforms.pixels, width: { value: 1 }, plain: { value: [0, 0, 0] } };
    this.ghost_uniforms = ghost;
    this.ghost = new Group();
    this.beams = [...shapes.most_elements].map((most) => new BeamMesh(most, shapes.rational, this.uniforms));
    shapes.set_factor(shapes.displaced ? 0 : 1);  // the ghost is the drawing, where it is known
    shapes.load(0);
    for (let beam = 0; beam < this.beams.length; ++beam) {
      const start = new BeamMesh(shapes.count(0, beam), shapes.rational, ghost);
      start.load(shapes, 0, beam, 0);
      start.object.renderOrder = -1;  // below the beams, whichever is nearer
      start.object.material.depthWrite = false;
      this.ghost.add(start.object);
      this.scene.add(this.beams[beam].object);
    }
    shapes.set_factor(1);
    shapes.load(0);
    this.add_sections();
    this.scene.add(this.ghost);
    const most = shapes.most_elements.reduce((sum, n) => sum + n + 1, 0);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * most), 3));
    this.node_material = new PointsMaterial({ size: 5, sizeAttenuation: false });
    this.nodes = new Points(geometry, this.node_material);
    this.nodes.frustumCulled = false;
    this.nodes.visible = false;
    this.scene.add(this.nodes);
  }

  /** The sections of the beams that have torsion and an outline. */
  add_sections() {
    const { shapes, run } = this.data;
    const outlines = (run?.model?.beams ?? []).map((beam) => beam['section outline [m]']);
    this.sections = this.beams.map((_, beam) => {
      if (!shapes.sections || !outlines[beam]) {
        return null;
      }
      const mesh = new SectionMesh(shapes.most_elements[beam], shapes.rational, outlines[beam], this.uniforms.map);
      this.scene.add(mesh.object);
      return mesh;
    });
    this.has_sections = this.sections.some(Boolean);
  }

  show_sections(visible) {
    this.sections.forEach((mesh, beam) => {
      if (mesh) {
        mesh.object.visible = visible;
        this.beams[beam].object.visible = !visible;
      }
    });
    this.show(this.frame);
  }

  add_symbol(geometry, material, pixels) {
    const symbol = new Mesh(geometry, material);
    symbol.userData.pixels = pixels;
    this.pinned_size.push(symbol);
    this.scene.add(symbol);
    return symbol;
  }

  add_supports(supports) {
    this.supports = [];
    this.support_material = new MeshLambertMaterial();
    const cone = new ConeGeometry(0.62, 1, 4, 1).translate(0, -0.5, 0);  // its tip at the support
    const block = new BoxGeometry(1.5, 0.45, 1.5).translate(0, 0.225, 0);  // behind the clamped end
    for (const support of supports) {
      const clamped = support.type === 'clamped';
      const symbol = this.add_symbol(clamped ? block : cone, this.support_material, 17);
      symbol.position.copy(this.local(support['position [m]']));
      this.supports.push({ symbol, beam: this.data.names.beams.indexOf(support.beam), s: support['s [m]'] });
      const away = clamped ? new Vector3(...support.outward) : this.directions.up;
      symbol.quaternion.copy(new Quaternion().setFromUnitVectors(y_axis, away));
    }
  }

  /** Bodies, probes and the paths of the bodies. */
  add_points() {
    const { names } = this.data;
    this.body_material = new MeshLambertMaterial();
    this.probe_material = new MeshLambertMaterial();
    this.path_material = new LineBasicMaterial();
    const sphere = new SphereGeometry(1, 32, 20), diamond = new OctahedronGeometry(1);
    const histories = (of, i) => ['x', 'y', 'z'].map((name) => this.data.column(of, i, name));
    const point = (of, name, i) => ({
      name,
      symbol: this.add_symbol(of === 'body' ? sphere : diamond, of === 'body' ? this.body_material
        : this.probe_material, of === 'body' ? 9 : 6),
      histories: histories(of, i),
      of,
      shift: of === 'body' ? this.shift_of_body(name, i) : this.shift_of_probe(i),
    });
    this.points = [...names.bodies.map((name, i) => point('body', name, i)),
      ...names.probes.map((name, i) => point('probe', name, i))];
    this.paths = new Group();
    this.scene.add(this.paths);
    this.box_material = new MeshLambertMaterial({ transparent: true, opacity: 0.45, depthWrite: false });
    this.boxes = new Boxes(this.data, this.box_material, this.path_material);
    this.scene.add(this.boxes.object);
  }

  /** What exaggerated displacements add to the position of a body in a frame: to that of the beam that carries it. */
  shift_of_body(name, i) {
    const joint = this.data.run?.model?.joints?.find((one) => one.body === name);
    const beam = this.data.names.beams.indexOf(joint?.beam), s = this.data.column('body', i, 's');
    return (frame) => (beam >= 0 && s && !Number.isNaN(s.values[frame]) ? this.data.shapes.shift(beam, s.values[frame]) : [0, 0, 0]);
  }

  shift_of_probe(i) {
    const columns = ['ux', 'uy', 'uz'].map((name) => this.data.column('probe', i, name));
    return (frame) => (columns[0] ? columns.map(({ values }) => (this.data.shapes.factor - 1) * values[frame]) : [0, 0, 0]);
  }

  /** A place, relative to the origin of the shapes, where its height is shown. */
  placed(place) {
    return raised(new Vector3(...place), this.directions.up, this.heights);
  }

  /** How many times heights may be shown so that a long line is no stroke. */
  get suited_heights() {
    return this.has_sections ? 1 : suited_heights(this.box_points, this.directions.up, [this.view.right, this.view.front]);
  }

  set_heights(factor) {
    this.heights = factor;
    const matrix = raising_matrix(this.directions.up, factor);
    for (const object of [this.grid, this.ghost, this.nodes, this.paths, ...this.beams.map((beam) => beam.object)]) {
      object.matrixAutoUpdate = false;
      object.matrix.copy(matrix);
      object.matrixWorldNeedsUpdate = true;
    }
    this.show(this.frame);
    if (this.is_fitted) {
      this.fit();
    }
  }

  /** Shows displacements from the drawing times `factor`. */
  exaggerate(factor) {
    this.data.shapes.set_factor(factor);
    this.show(this.frame);
  }

  local(world) {
    const { origin } = this.data.shapes;
    return new Vector3(world[0] - origin[0], world[1] - origin[1], world[2] - origin[2]);
  }

  /** Makes the paths of the bodies when they are first wanted. */
  show_paths(visible) {
    if (visible && this.paths.children.length === 0) {
      const { origin } = this.data.shapes;
      for (const { histories } of this.points.filter((point) => point.of === 'body')) {
        const places = new Float32Array(3 * this.data.time.length);
        histories.forEach(({ values }, k) => values.forEach((value, i) => { places[3 * i + k] = value - origin[k]; }));
        this.paths.add(new Line(new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3)),
          this.path_material));
      }
    }
    this.paths.visible = visible;
    this.redraw();
  }

  show_nodes(visible) {
    this.nodes.visible = visible;
    this.show(this.frame);
  }

  show_loads(visible) {
    this.loads.object.visible = visible;
    this.redraw();
  }

  show_start(visible) {
    this.ghost.visible = visible;
    this.redraw();
  }

  /** Colours by a field, over its range in the whole run or, with `instant`, in the shown frame. */
  set_field(field, instant) {
    this.field = field;
    const { shapes } = this.data;
    shapes.load(this.frame);
    this.colours = field_colours(instant ? shapes.field_range(field) : shapes.fields[field]);
    const texture = this.uniforms.map.value;
    texture.image.data.set(this.colours.table);
    texture.needsUpdate = true;
    this.show(this.frame);
    return this.colours;
  }

  /** Colours of the page's present scheme. */
  set_scheme() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => new Color().setStyle(style.getPropertyValue(name).trim(), SRGBColorSpace);
    this.renderer.setClearColor(colour('--scene'), 1);
    this.grid_material.color = colour('--scene-grid');
    this.support_material.color = colour('--scene-support');
    this.body_material.color = colour('--scene-body');
    this.box_material.color = colour('--scene-body');
    this.probe_material.color = colour('--scene-probe');
    this.path_material.color = colour('--scene-path');
    this.loads.material.color = colour('--scene-load');
    this.connectors.material.color = colour('--scene-connector');
    this.connectors.slack_material.color = colour('--scene-slack');
    this.node_material.color = colour('--scene-node');
    // The beams' own shaders write the colours of the screen as they are.
    const screen_colour = (name) => colour(name).convertLinearToSRGB().toArray();
    this.ghost_uniforms.plain.value = screen_colour('--scene-ghost');
    this.uniforms.outline.value = screen_colour('--scene-outline');
    this.redraw();
  }

  resize() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    if (box.width < 1 || box.height < 1) {
      return;
    }
    const first = this.view.width === 1;
    const factor = Math.min(box.width / this.view.width, box.height / this.view.height);
    this.renderer.setSize(box.width, box.height, false);
    this.uniforms.pixels.value.set(box.width, box.height);
    this.uniforms.width.value = box.width < 600 ? 5 : 7;
    this.ghost_uniforms.width.value = 2;
    if (!first) {
      this.view.scale *= factor;
      this.view.fitted *= factor;
    }
    this.view.resize(box.width, box.height);
    if (this.is_fitted) {
      this.fit();
    }
    this.draw();
  }

  /** Shows the whole run, and the present frame where displacements are exaggerated. */
  fit() {
    const { shapes } = this.data;
    const extent = shapes.factor > 1 ? corners(shapes.extent(), [0, 0, 0]) : [];
    this.view.box_points = [...this.box_points, ...extent].map((point) => this.placed(point));
    this.view.fit();
    this.is_fitted = true;
    this.redraw();
  }

  /** The reader has moved the camera. */
  moved() {
    this.is_fitted = false;
    this.redraw();
  }

  set_view(name) {
    this.view.set_view(name);
    this.fit();
  }

  /** Shows a frame: only what depends on time. */
  show(frame) {
    this.frame = frame;
    const { shapes } = this.data;
    shapes.load(frame);
    for (let beam = 0; beam < this.beams.length; ++beam) {
      this.beams[beam].load(shapes, frame, beam, this.field);
      this.sections[beam]?.load(shapes, frame, beam, this.field);
      if (this.colours) {
        const range = shapes.beam_range(frame, beam, this.field);
        this.beams[beam].set_range(range, this.colours);
        this.sections[beam]?.set_range(range, this.colours);
      }
    }
    for (const { symbol, histories, shift } of this.points) {
      const [x, y, z] = shift(frame);
      symbol.position.copy(this.placed([histories[0].values[frame] - shapes.origin[0] + x,
        histories[1].values[frame] - shapes.origin[1] + y, histories[2].values[frame] - shapes.origin[2] + z]));
    }
    for (const { symbol, beam, s } of this.supports) {
      const place = shapes.point(beam, s);
      if (place) {
        symbol.position.copy(this.placed(place.r));
      }
    }
    this.boxes.show(frame, (place) => this.placed(place));
    this.loads.show(frame);
    this.connectors.show(frame);
    if (this.nodes.visible) {
      this.load_nodes(frame);
    }
    this.redraw();
  }

  load_nodes(frame) {
    const { shapes } = this.data;
    const places = this.nodes.geometry.attributes.position;
    let to = 0;
    for (let beam = 0; beam < this.beams.length; ++beam) {
      let from = shapes.points_start(beam);
      for (let i = shapes.count(frame, beam); i >= 0; --i, from += 9) {
        places.array[to++] = shapes.floats[from];
        places.array[to++] = shapes.floats[from + 1];
        places.array[to++] = shapes.floats[from + 2];
      }
    }
    this.nodes.geometry.setDrawRange(0, to / 3);
    places.needsUpdate = true;
  }

  /** Draws before the next picture of the screen; many calls make one drawing. */
  redraw() {
    if (!this.pending) {
      this.pending = requestAnimationFrame(this.draw_pending ??= () => {
        this.pending = 0;
        this.draw();
      });
    }
  }

  draw() {
    const { view } = this;
    this.light.position.copy(view.z).addScaledVector(view.y, 0.8).addScaledVector(view.x, -0.4);
    for (const symbol of this.pinned_size) {
      symbol.scale.setScalar(symbol.userData.pixels / view.scale);
    }
    this.connectors.draw(view.scale);
    const least_pixels = 8;
    const factors = this.sections.filter((mesh) => mesh?.object.visible)
      .map((mesh) => mesh.enlarge_to(least_pixels, view.scale));
    const factor = Math.max(1, ...factors);
    const shown = this.data.shapes.factor;
    this.overlay.enlarged([[this.heights, 'heights'], [shown, 'deformation'], [factor > 1.05 ? factor : 1, 'sections']]);
    this.renderer.render(this.scene, view.camera);
    this.overlay.draw(view);
  }
}

/** The direction in which a box has no extent worth speaking of, if there is just one. */
function flat_direction([low, high]) {
  const extents = low.map((value, k) => high[k] - value);
  const largest = Math.max(...extents);
  const flat = extents.map((extent) => extent <= 1e-9 * largest);
  return flat.filter(Boolean).length === 1 ? flat.map(Number) : null;
}
