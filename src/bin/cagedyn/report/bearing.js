// Pictures of the bearing at any time: `data` is what moves, `state` has magnification and length of arrows.
function bearing(data, state) {
  const colors = {
    ink: "#222b35", muted: "#66717d", grid: "#d9dde2", ring: "#c9d0d8", land: "#e3e8ee", cage: "#d8b56a",
    rim: "#f0e2bf", metal: "#eef1f4", first: "#9fc0e4", raceway: "#b82e3a", pocket: "#74549a", guide: "#1c7f5c",
    path: "#1f5fa6",
  };
  const TURN = 2 * Math.PI;
  const frames = data.times.length;
  const pitch = data.pitch_radius;
  const radius = data.element_radius;

  // ---- Numbers of the frames ----

  const plain = (x, n) => (x !== 0 && (x < 1e-3 || x >= 1e6) ? x.toExponential(n - 1) : String(Number(x.toPrecision(n))));
  const force = (x) => `${plain(x, 3)} N`;

  // Value of a packed column at a fraction of frames, of element `j` of several.
  function between(packed, at, j = 0) {
    const first = Math.min(Math.floor(at), frames - 1);
    const share = at - first;
    const low = packed.values[j * frames + first];
    const high = packed.values[j * frames + Math.min(first + 1, frames - 1)];
    return packed.unit * (low + share * (high - low));
  }

  // Forces jump, so the frame that was reached last counts.
  const reached = (packed, at, j = 0) => packed.unit * packed.values[j * frames + Math.floor(at + 1e-9)];
  const ring = (at) => (data.ring ? data.ring.map((packed) => between(packed, at)) : [0, 0]);

  // Forces that arrows of the usual length stand for: what the largest one exceeds in few frames only, so that a single hit
  // does not make all others invisible.
  function scale(columns) {
    const most = data.times.map((_, i) => {
      let found = 0;
      for (const of of columns) found = Math.max(found, of(i));
      return found;
    });
    const sorted = most.filter((x) => x > 0).sort((x, y) => x - y);
    return sorted.length ? Number(sorted[Math.floor(0.9 * (sorted.length - 1))].toPrecision(2)) : 0;
  }
  const ofAll = (packed) => (i) => {
    let found = 0;
    for (let j = 0; j < data.count; j += 1) found = Math.max(found, Math.abs(packed.unit * packed.values[j * frames + i]));
    return found;
  };
  const ofGuide = ([y, z]) => (i) => Math.hypot(y.unit * y.values[i], z.unit * z.values[i]);
  // On the cage it is that of the records, beside which the largest forces of single steps are cut.
  const onCage = Math.max(Number((data.forces.pocket_usual ?? 0).toPrecision(2)), data.forces.guide ? scale([ofGuide(data.forces.guide)]) : 0);
  const scales = {
    raceway: scale([data.forces.inner, data.forces.outer].filter(Boolean).map(ofAll)),
    cage: onCage > 0 || !data.forces.pocket ? onCage : scale([ofAll(data.forces.pocket)]),
  };

  // ---- What is drawn, with all play magnified ----

  const rightwards = (angle) => [Math.cos(angle), Math.sin(angle)];
  const clearance = data.guide ? data.guide.clearance : null;
  const pocket = data.pocket_clearance;
  // The height of the cage, which no scene tells: from the middle to the guide, and as far or a little less on the other side.
  const toGuide = data.guide ? Math.abs(data.guide.radius - pitch) - data.guide.clearance : 0.45 * radius;
  const middle = data.neutral_radius ?? pitch;
  const halfHeight = Math.max(
    data.neutral_radius && data.guide ? Math.abs(data.guide.radius - middle) - data.guide.clearance : toGuide,
    0.3 * radius,
  );
  const otherHalf = Math.min(halfHeight, Math.max(0.4 * radius, data.neutral_radius ? halfHeight : 0));
  const room = 0.43 * TURN * pitch / data.count;
  const mostPlay = Math.max(pocket ?? 0, clearance ?? 0, 0.5 * data.raceway_play);

  // What changes its size so that magnified play has room: elements shrink and raceways of the scene with them; half of the
  // clearance of the guide is taken from its ring, as far as the raceway lets it, and the rest from the cage.
  function sizes(m) {
    const shown = Math.min(radius, pocket ? room - m * pocket : radius);
    const play = 0.5 * m * data.raceway_play;
    const [inner, outer] = data.raceways_known ? [pitch - shown - play, pitch + shown + play] : data.raceways;
    let [land, shift] = [0, 0];
    if (data.guide) {
      const free = (data.guide.inner ? data.guide.radius - inner : outer - data.guide.radius) - 0.05 * radius;
      land = Math.min(0.5 * (m - 1) * clearance, free);
      shift = (m - 1) * clearance - land;
    }
    return { m, shown, play, inner, outer, land, shift };
  }
  function fits(m) {
    const { shown, play, shift, inner, outer } = sizes(m);
    const far = otherHalf + shift + m * (clearance ?? 0);
    const clear = data.guide && data.guide.inner ? middle + far <= outer : middle - far >= inner;
    return shown >= 0.35 * radius && shift <= 0.6 * halfHeight && play <= radius && clear;
  }

  const limits = { low: 1, high: 1, usual: 1 };
  if (mostPlay > 0) {
    while (limits.high < 1000 && fits(1.02 * limits.high)) limits.high *= 1.02;
    const wanted = Math.max(0.35 * radius / mostPlay, 1);
    const digit = 10 ** Math.floor(Math.log10(wanted));
    limits.usual = Math.min(Math.floor(wanted / digit) * digit, limits.high);
  }

  function shapes(at) {
    const s = sizes(state.magnification);
    const m = s.m;
    const cage = data.cage ? [m * between(data.cage.y, at), m * between(data.cage.z, at)] : null;
    const turn = between(data.turn, at);
    const inner = data.guide && data.guide.inner;
    let bounds = [middle - otherHalf, middle + halfHeight];
    if (data.guide) {
      const surface = data.guide.radius + (inner ? 1 : -1) * (clearance + s.shift);
      const height = halfHeight + otherHalf;
      bounds = inner ? [surface, surface + height] : [surface - height, surface];
    }
    const waves = data.cage ? data.cage.waves.map(([n, a, b]) => [n, m * between(a, at), m * between(b, at)]) : [];
    const elements = [];
    for (let j = 0; j < data.count; j += 1) {
      const ahead = between(data.ahead, at, j) * (data.cage && pocket ? m : 1);
      const angle = data.first_angle + TURN * j / data.count + turn + ahead;
      const out = pitch + (data.raceways_known ? s.play : 0);
      elements.push({ angle, centre: rightwards(angle).map((x) => out * x) });
    }
    const [y, z] = ring(at);
    const land = data.guide ? data.guide.radius + (inner ? -s.land : s.land) : 0;
    return { ...s, cage, turn, bounds, waves, elements, land, ring: [m * y, m * z] };
  }

  // Place of a point of the cage at an angle in it and a radius; on the surface with its roundness.
  function ofCage(s, angle, at, surface) {
    let [out, ahead] = [at, 0];
    for (const [n, a, b] of s.waves) {
      const [c, d] = rightwards(n * angle);
      out += a * c + b * d;
      ahead -= (a * d - b * c) / n;
    }
    if (surface) {
      for (const [n, a, b] of data.roundness) out += s.m * a * Math.cos(n * angle + b);
    }
    const [c, d] = rightwards(angle + s.turn);
    return [s.cage[0] + out * c - ahead * d, s.cage[1] + out * d + ahead * c];
  }

  // ---- The picture of the bearing ----

  const canvas = document.getElementById("bearing");
  const reach = data.raceways[1] + 1.0 * radius;
  const bore = Math.max(data.raceways[0] - 0.9 * radius, 0.2 * data.raceways[0]);

  // A surface of some size in CSS px with y upwards; `extent` in m is half of its width.
  function surface(target, extent) {
    const size = Math.max(target.clientWidth, 200);
    const ratio = Math.max(2, window.devicePixelRatio || 1);
    target.width = Math.round(size * ratio);
    target.height = target.width;
    const draw = target.getContext("2d", { willReadFrequently: true });
    draw.fillStyle = "#fff";
    draw.fillRect(0, 0, target.width, target.height);
    const scale = 0.5 * target.width / extent;
    return { draw, ratio, extent, px: ([y, z]) => [0.5 * target.width + scale * y, 0.5 * target.height - scale * z], scale };
  }

  function circle(on, centre, r, fill, line, width = 1) {
    const [x, y] = on.px(centre);
    on.draw.beginPath();
    on.draw.arc(x, y, Math.max(on.scale * r, 0), 0, TURN);
    paint(on, fill, line, width);
  }

  function annulus(on, centre, from, to, fill, line) {
    const [x, y] = on.px(centre);
    on.draw.beginPath();
    on.draw.arc(x, y, on.scale * to, 0, TURN);
    on.draw.arc(x, y, on.scale * from, 0, TURN, true);
    paint(on, fill, null);
    circle(on, centre, from, null, line);
    circle(on, centre, to, null, line);
  }

  function paint(on, fill, line, width = 1) {
    if (fill) {
      on.draw.fillStyle = fill;
      on.draw.fill("evenodd");
    }
    if (line) {
      on.draw.strokeStyle = line;
      on.draw.lineWidth = width * on.ratio;
      on.draw.stroke();
    }
  }

  function outline(on, points, fill, line, width, open) {
    on.draw.beginPath();
    points.forEach((point, i) => (i ? on.draw.lineTo(...on.px(point)) : on.draw.moveTo(...on.px(point))));
    if (!open) on.draw.closePath();
    paint(on, fill, line, width);
  }

  // An arrow for a force; one that is too long is cut and has two heads.
  const longest = 2.5;
  function arrow(on, from, direction, times, color) {
    const shown = Math.min(times, longest);
    const size = 1.2 * radius * shown * on.scale;
    if (!(size > 1.5 * on.ratio)) return;
    const [x, y] = on.px(from);
    const [c, d] = [direction[0], -direction[1]];
    const head = Math.min(7 * on.ratio, 0.6 * size);
    on.draw.beginPath();
    on.draw.moveTo(x, y);
    on.draw.lineTo(x + (size - 0.8 * head) * c, y + (size - 0.8 * head) * d);
    paint(on, null, color, 2.2);
    for (const end of times > longest ? [size, size - 1.1 * head] : [size]) {
      const tip = [x + end * c, y + end * d];
      on.draw.beginPath();
      on.draw.moveTo(...tip);
      on.draw.lineTo(tip[0] - head * c + 0.5 * head * d, tip[1] - head * d - 0.5 * head * c);
      on.draw.lineTo(tip[0] - head * c - 0.5 * head * d, tip[1] - head * d + 0.5 * head * c);
      paint(on, color, null);
    }
  }

  // Arrows of known forces, in the lower left corner.
  function drawScale(on) {
    const rows = [[scales.cage, colors.pocket, "on the cage"], [scales.raceway, colors.raceway, "on the raceways"]];
    on.draw.font = `${12 * on.ratio}px sans-serif`;
    on.draw.textBaseline = "middle";
    rows.filter(([force]) => force > 0).forEach(([newton, color, where], i) => {
      const from = [-0.97 * on.extent, (-0.955 + 0.05 * i) * on.extent];
      arrow(on, from, [1, 0], 1, color);
      on.draw.fillStyle = colors.ink;
      const [x, y] = on.px([from[0] + 1.35 * radius, from[1]]);
      on.draw.fillText(`${force(newton / state.arrows)} ${where}`, x, y);
    });
  }

  function drawCage(on, s) {
    const step = TURN / 360;
    const around = (at, surface) => Array.from({ length: 361 }, (_, i) => ofCage(s, i * step, at, surface));
    const guided = data.guide ? (data.guide.inner ? 0 : 1) : -1;
    const [inside, outside] = [around(s.bounds[0], guided === 0), around(s.bounds[1], guided === 1)];
    outline(on, [...outside, ...inside.reverse()], colors.rim, null);
    const wide = s.shown + s.m * (pocket ?? 0.1 * radius / s.m);
    const wall = (out) => {
      const edge = data.pocket_half_angle ? wide * Math.sin(data.pocket_half_angle) : 0;
      const along = Math.sqrt(wide * wide - Math.min(Math.abs(out - pitch), edge) ** 2);
      return Math.asin(Math.min(along / out, 1));
    };
    for (let j = 0; j < data.count; j += 1) {
      const first = data.first_angle + TURN * j / data.count;
      const next = first + TURN / data.count;
      const points = [];
      const line = (from, to) => Array.from({ length: 13 }, (_, i) => from + (to - from) * i / 12);
      for (const out of line(...s.bounds)) points.push(ofCage(s, first + wall(out), out, out === s.bounds[guided]));
      const [from, to] = [first + wall(s.bounds[1]), next - wall(s.bounds[1])];
      for (const angle of line(from, to)) points.push(ofCage(s, angle, s.bounds[1], guided === 1));
      for (const out of line(s.bounds[1], s.bounds[0])) points.push(ofCage(s, next - wall(out), out, out === s.bounds[guided]));
      const [low, high] = [next - wall(s.bounds[0]), first + wall(s.bounds[0])];
      for (const angle of line(low, high)) points.push(ofCage(s, angle, s.bounds[0], guided === 0));
      outline(on, points, colors.cage, "#8a6d25", 0.8);
    }
    outline(on, outside, null, "#8a6d25", 0.8, true);
    outline(on, inside, null, "#8a6d25", 0.8, true);
  }

  function drawForces(on, s, at) {
    const along = (force, scale) => (scale > 0 ? state.arrows * Math.abs(force) / scale : 0);
    s.elements.forEach(({ angle, centre }, j) => {
      const outwards = rightwards(angle);
      const forward = [-outwards[1], outwards[0]];
      const from = (r, direction) => [centre[0] + r * direction[0], centre[1] + r * direction[1]];
      if (data.forces.outer) {
        arrow(on, from(s.shown, outwards), outwards, along(reached(data.forces.outer, at, j), scales.raceway), colors.raceway);
      }
      if (data.forces.inner) {
        const inwards = outwards.map((x) => -x);
        arrow(on, from(s.shown, inwards), inwards, along(reached(data.forces.inner, at, j), scales.raceway), colors.raceway);
      }
      if (data.forces.pocket) {
        const force = reached(data.forces.pocket, at, j);
        const direction = forward.map((x) => Math.sign(force) * x);
        arrow(on, from(s.shown, direction), direction, along(force, scales.cage), colors.pocket);
      }
    });
    if (data.forces.guide && s.cage) {
      const force = data.forces.guide.map((packed) => reached(packed, at));
      const size = Math.hypot(...force);
      if (size > 0) {
        const direction = force.map((x) => x / size);
        const out = data.guide.inner ? s.bounds[0] : -s.bounds[1];
        arrow(on, s.cage.map((x, i) => x + out * direction[i]), direction, along(size, scales.cage), colors.guide);
      }
    }
  }

  function drawBearing(at) {
    const s = shapes(at);
    const on = surface(canvas, 1.06 * reach);
    annulus(on, [0, 0], s.outer, reach, colors.ring, colors.muted);
    if (data.guide && !data.guide.inner) {
      annulus(on, [0, 0], s.land, s.outer, colors.land, null);
      circle(on, [0, 0], s.land, null, colors.ink, 1.4);
    }
    annulus(on, s.ring, bore, s.inner, colors.ring, colors.muted);
    if (data.guide && data.guide.inner) {
      annulus(on, s.ring, s.inner, s.land, colors.land, null);
      circle(on, s.ring, s.land, null, colors.ink, 1.4);
    }
    const mark = rightwards(Math.PI / 2 + between(data.ring_angle, at));
    const markAt = (r) => [s.ring[0] + r * mark[0], s.ring[1] + r * mark[1]];
    outline(on, [markAt(bore), markAt(bore + 0.45 * radius)], null, colors.ink, 3, true);
    if (data.outer_ring_angle) {
      const turned = rightwards(Math.PI / 2 + between(data.outer_ring_angle, at));
      outline(on, [reach, reach - 0.45 * radius].map((r) => turned.map((x) => r * x)), null, colors.ink, 3, true);
    }
    if (s.cage) drawCage(on, s);
    s.elements.forEach(({ centre }, j) => {
      circle(on, centre, s.shown, j ? colors.metal : colors.first, colors.ink);
      if (data.spin) {
        const spin = rightwards(data.first_angle + TURN * j / data.count + between(data.spin, at, data.kind === "roller" ? j : 0));
        const point = (r) => [centre[0] + r * s.shown * spin[0], centre[1] + r * s.shown * spin[1]];
        outline(on, [point(0), point(0.85)], null, colors.muted, 1.6, true);
      }
      circle(on, centre, 0.08 * s.shown, colors.muted, null);
    });
    if (state.arrows > 0) {
      drawForces(on, s, at);
      drawScale(on);
    }
    return s;
  }

  // ---- The place of the cage centre ----

  // Seen from the centre of the guiding ring, in units of the clearance if there is a guide, else in mm.
  const unit = clearance ?? 1e-3;
  function centreAt(at) {
    const [y, z] = data.guide && data.guide.inner ? ring(at) : [0, 0];
    return [(between(data.cage.y, at) - y) / unit, (between(data.cage.z, at) - z) / unit];
  }
  const path = data.cage ? data.times.map((_, i) => centreAt(i)) : [];
  const farthest = path.reduce((most, point) => Math.max(most, Math.hypot(...point)), clearance ? 1 : 1e-9);

  function drawOrbit(at) {
    const target = document.getElementById("orbit");
    if (!data.cage) {
      target.hidden = true;
      return;
    }
    const on = surface(target, 1.12 * farthest);
    const end = 1.06 * farthest;
    outline(on, [[-end, 0], [end, 0]], null, colors.grid, 1, true);
    outline(on, [[0, -end], [0, end]], null, colors.grid, 1, true);
    if (clearance) circle(on, [0, 0], 1, null, colors.ink, 1.4);
    outline(on, path, null, "#a9bbd0", 0.8, true);
    const now = Math.floor(at);
    const trail = path.slice(Math.max(0, now - 25), now + 1).concat([centreAt(at)]);
    outline(on, trail, null, colors.path, 2, true);
    circle(on, centreAt(at), 5 * on.ratio / on.scale, colors.path, "#fff", 1.5);
  }

  return {
    colors, frames, radius, clearance, farthest, scales, limits, canvas, between, reached, shapes, centreAt, drawBearing, drawOrbit,
    plain, force,
  };
}
