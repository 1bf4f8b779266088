// Connectors as lines between their ends: rods thick, what is slack dashed and pale.
import { BufferAttribute, BufferGeometry, CylinderGeometry, Group, Line, LineDashedMaterial, Mesh, MeshLambertMaterial, Vector3 } from 'three';

const y_axis = new Vector3(0, 1, 0);
const rod_radius = 2.4, line_radius = 1.2;  // [pixels]
const dash = 7, gap = 5;

/** One that carries one sign alone and carries nothing; where the model is not known, all that carry nothing. */
const is_slack = (type, force) => force === 0 && type !== 'rod' && type !== 'spring';

export class Connectors {
  /** placed(r): where r is shown. */
  constructor(data, placed) {
    this.placed = placed;
    this.shapes = data.shapes;
    this.object = new Group();
    this.material = new MeshLambertMaterial();
    this.slack_material = new LineDashedMaterial();
    const described = data.run?.model?.connectors ?? [];
    const column = (i, name) => data.column('connector', i, name);
    this.connectors = (data.names.connectors ?? []).filter((_, i) => column(i, 'from_position.x')).map((name, i) => {
      const one = described.find((each) => each.name === name), type = one?.type;
      const taut = new Mesh(new CylinderGeometry(1, 1, 1, 10), this.material);
      taut.userData.radius = type === 'rod' ? rod_radius : line_radius;
      const slack = new Line(new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(6), 3)),
        this.slack_material);
      slack.frustumCulled = false;
      this.object.add(taut, slack);
      const place = (end) => ({ columns: ['x', 'y', 'z'].map((axis) => column(i, `${end}_position.${axis}`)),
        beam: data.names.beams.indexOf(one?.[end]?.beam), s: one?.[end]?.['s [m]'] });
      return { type, taut, slack, from: place('from'), to: place('to'), force: column(i, 'force') };
    });
  }

  show(frame) {
    const from = new Vector3(), to = new Vector3();
    const load = (end, { columns, beam, s }) => {
      const shift = beam >= 0 ? this.shapes.shift(beam, s) : [0, 0, 0];
      end.copy(this.placed(columns.map(({ values }, k) => values[frame] - this.shapes.origin[k] + shift[k])));
    };
    for (const connector of this.connectors) {
      const { taut, slack } = connector;
      load(from, connector.from);
      load(to, connector.to);
      const length = from.distanceTo(to);
      const seen = length > 0, hangs_loose = is_slack(connector.type, connector.force.values[frame]);
      taut.visible = seen && !hangs_loose;
      slack.visible = seen && hangs_loose;
      if (!seen) {
        continue;
      }
      taut.position.addVectors(from, to).multiplyScalar(0.5);
      taut.scale.y = length;
      taut.quaternion.setFromUnitVectors(y_axis, to.clone().sub(from).divideScalar(length));
      const ends = slack.geometry.attributes.position;
      ends.setXYZ(0, ...from);
      ends.setXYZ(1, ...to);
      ends.needsUpdate = true;
      slack.computeLineDistances();
    }
  }

  /** Widths and dashes are in pixels: `scale` of them are a metre. */
  draw(scale) {
    for (const { taut } of this.connectors) {
      taut.scale.x = taut.scale.z = taut.userData.radius / scale;
    }
    this.slack_material.dashSize = dash / scale;
    this.slack_material.gapSize = gap / scale;
  }
}
