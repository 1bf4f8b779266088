// The loads of the model as arrows that stand where they act, and move and grow with them.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshLambertMaterial, Quaternion, TorusGeometry, Vector3 } from 'three';

const y_axis = new Vector3(0, 1, 0);
const longest = 46, shortest = 16;  // [pixels]
const arrows_along = 9;  // of a load on a whole beam

/** An arrow of length 1 along y, its tip at the origin; a moment has two heads. */
function arrow(material, is_moment) {
  const group = new Group();
  const part = (geometry, y) => {
    const mesh = new Mesh(geometry, material);
    mesh.position.y = y;
    group.add(mesh);
  };
  part(new CylinderGeometry(0.055, 0.055, 0.75, 12), -0.625);
  part(new ConeGeometry(0.16, 0.3, 20), -0.14);
  if (is_moment) {
    part(new ConeGeometry(0.16, 0.3, 20), -0.42);
  }
  return group;
}

/** A ring of diameter 1 about y that turns by the right hand, for what acts about an axis inside a beam. */
function turning_arrow(material) {
  const group = new Group();
  const part = (geometry) => group.add(new Mesh(geometry.rotateX(-Math.PI / 2), material));
  part(new TorusGeometry(0.5, 0.05, 10, 36, 1.5 * Math.PI));
  part(new ConeGeometry(0.15, 0.3, 20).rotateZ(-Math.PI / 2).translate(0.1, -0.5, 0));
  return group;
}

/** Factor of a load at a time, linear between the rows of its table. */
function factor_at(rows, t) {
  if (!rows?.length) {
    return 1;
  }
  const next = rows.findIndex(([time]) => time > t);
  if (next <= 0) {
    return rows[next === 0 ? 0 : rows.length - 1][1];
  }
  const [t0, y0] = rows[next - 1], [t1, y1] = rows[next];
  return y0 + ((y1 - y0) * (t - t0)) / (t1 - t0);
}

export class LoadArrows {
  /** pin(symbol): its scale is to follow the zoom so that it is userData.pixels long; placed(r): where r is shown. */
  constructor(loads, data, pin, placed) {
    this.data = data;
    this.placed = placed;
    this.object = new Group();
    this.material = new MeshLambertMaterial();
    this.loads = loads.map((load) => {
      const is_moment = load.kind.startsWith('moment'), along = load.kind.includes('per length');
      const value = [load.value].flat(), about_axis = value.length === 1;
      const arrows = Array.from({ length: along ? arrows_along : 1 }, () => {
        const symbol = about_axis ? turning_arrow(this.material) : arrow(this.material, is_moment);
        pin(symbol);
        this.object.add(symbol);
        return symbol;
      });
      return { ...load, along, arrows, beam: data.names.beams.indexOf(load.beam), size: Math.hypot(...value),
        follows: load.direction !== 'fixed', about_axis };
    });
    data.shapes.load(0);
    const steepest = (rows) => (rows?.length ? Math.max(...rows.map(([, y]) => Math.abs(y))) : 1);
    for (const load of this.loads) {
      load.start = load.along ? null : data.shapes.point(load.beam, load['s [m]']);
    }
    // Kinds cannot be compared with each other: the largest of each is longest.
    this.largest = {};
    for (const { kind, size, factor } of this.loads) {
      this.largest[kind] = Math.max(this.largest[kind] ?? 0, size * steepest(factor));
    }
  }

  show(frame) {
    const { shapes, time } = this.data;
    const turn = new Quaternion(), turned = new Vector3();
    for (const load of this.loads) {
      const factor = factor_at(load.factor, time[frame]);
      const part = (load.size * Math.abs(factor)) / this.largest[load.kind];
      load.arrows.forEach((symbol, i) => {
        const place = shapes.point(load.beam, this.place(load, i, time[frame]));
        symbol.visible = Boolean(place) && part > 1e-6;
        if (!symbol.visible) {
          return;
        }
        symbol.position.copy(this.placed(place.r));
        if (load.about_axis) {
          turned.set(...place.t).multiplyScalar(Math.sign(load.value * factor));
        } else {
          turned.set(...load.value).normalize().multiplyScalar(Math.sign(factor));
        }
        if (load.follows && load.start) {
          turned.applyQuaternion(turn.setFromUnitVectors(new Vector3(...load.start.t), new Vector3(...place.t)));
        }
        symbol.quaternion.setFromUnitVectors(y_axis, turned);
        symbol.userData.pixels = shortest + (longest - shortest) * part;
      });
    }
  }

  /** s of an arrow at a time. */
  place(load, i, t) {
    if (!load.along) {
      return load['s [m]'] + load['place speed [m/s]'] * t;
    }
    const { shapes } = this.data;
    const first = shapes.places_start(shapes.frame, load.beam), last = first + shapes.count(shapes.frame, load.beam);
    return shapes.floats[first] + ((i + 0.5) / arrows_along) * (shapes.floats[last] - shapes.floats[first]);
  }
}
