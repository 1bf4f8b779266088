// Time: which frame is shown, and playing.

export const speeds = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1000];

/** The speed nearest to real time with which the whole run takes between 4 and 15 seconds. */
export function usual_speed(duration) {
  const fitting = speeds.filter((speed) => duration / speed >= 3.9 && duration / speed <= 15);
  const to_real_time = (speed) => Math.abs(Math.log(speed));
  return (fitting.length ? fitting : speeds).reduce((a, b) => (to_real_time(b) < to_real_time(a) ? b : a));
}

export class Player {
  /** changed() is called when the frame or anything else here has changed. */
  constructor(time, changed) {
    this.time = time;
    this.changed = changed;
    this.last = time.length - 1;
    this.frame = 0;
    this.now = time[0];
    this.playing = false;
    this.loop = false;
    this.speed = usual_speed(time[this.last] - time[0]);
    this.tick = (clock) => this.advance(clock);
  }

  go(frame) {
    this.frame = Math.min(Math.max(frame, 0), this.last);
    this.now = this.time[this.frame];
    this.changed();
  }

  /** Goes to the frame nearest to a time. */
  go_to_time(time) {
    this.go(this.frame_at(time, 0.5));
  }

  /** The frame before `time`, or the one after it from `part` of the way on. */
  frame_at(time, part) {
    let low = 0, high = this.last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= time) { low = middle; } else { high = middle; }
    }
    return time >= this.time[low] + part * (this.time[high] - this.time[low]) ? high : low;
  }

  play() {
    if (this.last === 0) {
      return;
    }
    if (this.frame === this.last) {
      this.go(0);
    }
    this.playing = true;
    this.clock = undefined;
    requestAnimationFrame(this.tick);
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  toggle() {
    if (this.playing) { this.pause(); } else { this.play(); }
  }

  advance(clock) {
    if (!this.playing) {
      return;
    }
    const passed = this.clock === undefined ? 0 : Math.min((clock - this.clock) / 1000, 0.25);
    this.clock = clock;
    this.now += passed * this.speed;
    const end = this.time[this.last];
    if (this.now >= end) {
      if (!this.loop) {
        this.playing = false;
        this.go(this.last);
        return;
      }
      this.now = this.time[0];
    }
    const frame = this.frame_at(this.now, 1);
    if (frame !== this.frame) {
      this.frame = frame;
      this.changed();
    }
    requestAnimationFrame(this.tick);
  }
}
