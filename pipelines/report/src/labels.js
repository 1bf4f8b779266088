// Names beside their points, none over another.
const beside = 8, above = 28, below = 7;  // [pixels]
const most_rows = 12;

/** Where a label of a size may stand about its point, the nearest first: [x, y] of its upper left corner. */
function places(width, height, first_below) {
  const found = [];
  for (let row = 0; row < most_rows; ++row) {
    const up = -above - row * height, down = below + row * height;
    for (const y of first_below ? [down, up] : [up, down]) {
      found.push([beside, y], [-beside - width, y]);
    }
  }
  return found;
}

export class Labels {
  /** labels: [{ label, is_below }], elements in the order in which they choose their places. */
  constructor(labels) {
    this.labels = labels.map(({ label, is_below }) => ({ label, is_below, chosen: 0 }));
  }

  /** Moves the labels to their points, [x, y] in pixels; each stays beside its point where it has been if it can. */
  place(points) {
    const taken = [];
    this.labels.forEach((one, i) => {
      one.width ||= one.label.offsetWidth;
      one.height ||= one.label.offsetHeight;
      const { width, height } = one;
      one.places ??= width ? places(width, height, one.is_below) : null;
      const all = one.places ?? [[beside, one.is_below ? below : -above]];
      const box_at = ([dx, dy]) => [points[i][0] + dx, points[i][1] + dy];
      const is_free = (place) => {
        const [x, y] = box_at(place);
        return taken.every((box) => x >= box.x + box.width || x + width <= box.x || y >= box.y + box.height || y + height <= box.y);
      };
      if (!is_free(all[one.chosen])) {
        one.chosen = Math.max(all.findIndex(is_free), 0);
      } else if (one.chosen > 0 && is_free(all[0])) {
        one.chosen = 0;
      }
      const [x, y] = box_at(all[one.chosen]);
      taken.push({ x, y, width, height });
      one.label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }
}
