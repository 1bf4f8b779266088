// Heights that are shown larger than they are, as drawings of ropeways have them.
import { Matrix4 } from 'three';

/** Moves a point to so many times its height over the origin. */
export const raised = (point, up, factor) => point.addScaledVector(up, (factor - 1) * point.dot(up));

/** The same as a matrix, for whole objects. */
export function raising_matrix({ x, y, z }, factor) {
  const s = factor - 1;
  return new Matrix4().set(1 + s * x * x, s * x * y, s * x * z, 0, s * y * x, 1 + s * y * y, s * y * z, 0,
    s * z * x, s * z * y, 1 + s * z * z, 0, 0, 0, 0, 1);
}

/**
 * How many times the heights of points, along `up`, can be shown: to three tenths of their extent along the other
 * directions, at most 10 times. 1 where they are no long line, or have nothing but a deflection for height.
 */
export function suited_heights(points, up, others) {
  const extent = (direction) => {
    const along = points.map((point) => point.dot(direction));
    return Math.max(...along) - Math.min(...along);
  };
  const part = extent(up) / Math.max(...others.map(extent));
  return part < 0.004 || part > 0.12 ? 1 : Math.min(10, Math.floor(0.3 / part));
}
