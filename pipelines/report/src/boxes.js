// Rigid bodies as boxes of the same mass and inertia, which turn with them.
import { BoxGeometry, EdgesGeometry, Group, LineSegments, Matrix4, Mesh, Quaternion, Vector3 } from 'three';

/** The box of a body in the model of run.json: its sides along its principal axes, or null for a point mass. */
function box_of(body) {
  if (!body?.['box [m]']) {
    return null;
  }
  const [x, y, z] = body['box axes'].map((axis) => new Vector3(...axis));
  return { sides: body['box [m]'], turn: new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(x, y, z)) };
}

/** A box [low, high] of the run with room for the boxes of its bodies. */
export function with_room(box, data) {
  const [low, high] = box.map((corner) => [...corner]);
  data.names.bodies.forEach((name, i) => {
    const sides = data.run?.model?.bodies?.find((one) => one.name === name)?.['box [m]'];
    const radius = sides ? Math.hypot(...sides) / 2 : 0;
    ['x', 'y', 'z'].forEach((key, k) => {
      for (const value of (radius > 0 && data.column('body', i, key)?.values) || []) {
        low[k] = Math.min(low[k], value - radius);
        high[k] = Math.max(high[k], value + radius);
      }
    });
  });
  return [low, high];
}

export class Boxes {
  constructor(data, material, edges) {
    this.data = data;
    this.object = new Group();
    this.boxes = [];
    data.names.bodies.forEach((name, i) => {
      const box = box_of(data.run?.model?.bodies?.find((one) => one.name === name));
      const columns = ['qw', 'qx', 'qy', 'qz', 'x', 'y', 'z'].map((key) => data.column('body', i, key));
      if (!box || columns.some((column) => !column)) {
        return;
      }
      const mesh = new Mesh(new BoxGeometry(...box.sides), material);
      mesh.add(new LineSegments(new EdgesGeometry(mesh.geometry), edges));
      this.object.add(mesh);
      this.boxes.push({ mesh, turn: box.turn, values: columns.map((column) => column.values) });
    });
  }

  /** Where they are in a frame; `placed` puts a place into the scene. */
  show(frame, placed) {
    const { origin } = this.data.shapes;
    for (const { mesh, turn, values } of this.boxes) {
      const [w, x, y, z, ...place] = values.map((each) => each[frame]);
      mesh.quaternion.set(x, y, z, w).normalize().multiply(turn);
      mesh.position.copy(placed(place.map((value, k) => value - origin[k])));
    }
  }
}
