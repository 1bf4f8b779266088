// A camera without perspective, so that one scale bar holds for the whole picture; orbit, pan, zoom and standard views.
import { Matrix4, OrthographicCamera, Vector3 } from 'three';

const degrees = Math.PI / 180;
export const standard_views = {
  iso: { azimuth: 35 * degrees, elevation: 25 * degrees },
  front: { azimuth: 0, elevation: 0 },
  side: { azimuth: 90 * degrees, elevation: 0 },
  top: { azimuth: 0, elevation: 90 * degrees },
};

/** Two directions that the standard views follow: up, and from the model to the viewer of the front view. */
export function view_directions(gravity, plane_normal) {
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  const normal = plane_normal && new Vector3(...plane_normal).normalize();
  const up = new Vector3(...(gravity ?? [0, 0, 0])).negate();
  if (up.length() > 0) {
    up.normalize();
  } else {
    up.copy(normal && Math.abs(normal.z) > 0.9 ? axes[1] : axes[2]);
  }
  if (normal && Math.abs(normal.dot(up)) < 0.1) {
    const right = up.clone().cross(normal);
    const largest = [right.x, right.y, right.z].reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a));
    return { up, front: normal.multiplyScalar(largest < 0 ? -1 : 1) };
  }
  const right = Math.abs(up.x) > 0.9 ? axes[1] : axes[0];
  right.addScaledVector(up, -right.dot(up)).normalize();
  return { up, front: right.clone().cross(up) };
}

export class ViewCamera {
  constructor({ up, front }, box_points) {
    this.camera = new OrthographicCamera();
    this.camera.matrixAutoUpdate = false;
    this.up = up;
    this.front = front;
    this.right = up.clone().cross(front);
    this.box_points = box_points;
    this.target = new Vector3();
    this.scale = 1;  // pixels per metre
    this.width = this.height = 1;
    this.x = new Vector3();
    this.y = new Vector3();
    this.z = new Vector3();
    this.matrix = new Matrix4();
    this.set_view('front');
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    this.update();
  }

  set_view(name) {
    Object.assign(this, standard_views[name]);
    this.update();
  }

  /** Turns by pixels of the pointer. */
  orbit(dx, dy) {
    const per_pixel = 0.4 * degrees;
    this.azimuth -= dx * per_pixel;
    this.elevation = Math.min(Math.max(this.elevation + dy * per_pixel, -90 * degrees), 90 * degrees);
    this.update();
  }

  pan(dx, dy) {
    this.target.addScaledVector(this.x, -dx / this.scale).addScaledVector(this.y, dy / this.scale);
    this.update();
  }

  /** Zooms about a place of the picture, in pixels from its centre. */
  zoom(factor, x = 0, y = 0) {
    const scale = Math.min(Math.max(this.scale * factor, this.fitted / 50), this.fitted * 5000);
    const moved = 1 / this.scale - 1 / scale;
    this.target.addScaledVector(this.x, x * moved).addScaledVector(this.y, -y * moved);
    this.scale = scale;
    this.update();
  }

  /** Centres the box of the whole run and fills the picture with it, but for a margin [pixels]. */
  fit(margin = 56) {
    let left = Infinity, right = -Infinity, low = Infinity, high = -Infinity, back = Infinity, near = -Infinity;
    for (const point of this.box_points) {
      const x = point.dot(this.x), y = point.dot(this.y), z = point.dot(this.z);
      left = Math.min(left, x); right = Math.max(right, x);
      low = Math.min(low, y); high = Math.max(high, y);
      back = Math.min(back, z); near = Math.max(near, z);
    }
    this.target.set(0, 0, 0).addScaledVector(this.x, (left + right) / 2).addScaledVector(this.y, (low + high) / 2)
      .addScaledVector(this.z, (back + near) / 2);
    const room = (pixels) => Math.max(pixels - 2 * margin, pixels / 4);
    const size = Math.max(right - left, high - low, near - back) || 1;
    this.scale = Math.min(room(this.width) / Math.max(right - left, 1e-9 * size),
      room(this.height) / Math.max(high - low, 1e-9 * size), 5 * room(this.width) / size);
    this.fitted = this.scale;
    this.depth = 4 * size;
    this.update();
  }

  update() {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth);
    const ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    this.x.set(0, 0, 0).addScaledVector(this.right, ca).addScaledVector(this.front, -sa);
    this.z.set(0, 0, 0).addScaledVector(this.front, ce * ca).addScaledVector(this.right, ce * sa)
      .addScaledVector(this.up, se);
    this.y.copy(this.z).cross(this.x);
    const { camera } = this;
    const depth = (this.depth ?? 1) + 300 / this.scale;
    camera.matrix.makeBasis(this.x, this.y, this.z);
    camera.matrix.setPosition(this.target.x + depth * this.z.x, this.target.y + depth * this.z.y,
      this.target.z + depth * this.z.z);
    camera.left = -this.width / 2 / this.scale;
    camera.right = -camera.left;
    camera.top = this.height / 2 / this.scale;
    camera.bottom = -camera.top;
    camera.near = 0;
    camera.far = 2 * depth;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
  }
}

/** Mouse, touch and wheel on `canvas` move the camera; `changed` is called after each move. */
export function steer(canvas, view, changed) {
  const pointers = new Map();
  const middle = () => {
    const [a, b] = [...pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  const from_centre = (x, y) => {
    const box = canvas.getBoundingClientRect();
    return [x - box.left - box.width / 2, y - box.top - box.height / 2];
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    const dx = event.clientX - before.x, dy = event.clientY - before.y;
    if (pointers.size === 2) {
      const old = middle();
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      const now = middle();
      view.pan(now.x - old.x, now.y - old.y);
      view.zoom(now.spread / (old.spread || 1), ...from_centre(now.x, now.y));
    } else {
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (event.shiftKey || event.buttons & 6) {
        view.pan(dx, dy);
      } else {
        view.orbit(dx, dy);
      }
    }
    changed();
  });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 20 : 1);
    view.zoom(Math.exp(-pixels * 0.0015), ...from_centre(event.clientX, event.clientY));
    changed();
  }, { passive: false });
}
