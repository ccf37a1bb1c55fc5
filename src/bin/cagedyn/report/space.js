// A bearing in space at any time, turned as `state.view` says: its rings cut open, its balls, their contacts and axes.
function inSpace(data, state, { between, reached, scales, colors, canvas }) {
  const TURN = 2 * Math.PI;
  const { pitch_radius: pitch, element_radius: radius, space } = data;
  const [spread, thick] = [0.62, 0.3 * radius];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const sum = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
  const times = (a, x) => [a[0] * x, a[1] * x, a[2] * x];

  // Largest displacement of ring or cage, which the usual magnification makes a sixth of a ball.
  const displaced = (at) => space.ring.map((packed) => between(packed, at));
  const ofCage = (at) => (space.cage ?? []).map((packed) => between(packed, at));
  const lever = [1, 1, 1, pitch, pitch];
  let most = 0;
  for (let i = 0; i < data.times.length; i += 1) {
    [displaced(i), ofCage(i)].forEach((all) => all.forEach((x, k) => { most = Math.max(most, Math.abs(x) * lever[k]); }));
  }
  const wanted = most > 0 ? Math.max(radius / 6 / most, 1) : 1;
  const digit = 10 ** Math.floor(Math.log10(wanted));
  const limits = { low: 1, high: Math.max(4 * wanted, 1), usual: Math.floor(wanted / digit) * digit };

  // x along the axis of the bearing, y to the right, z upwards; seen along -x it is the picture of the plane.
  function camera() {
    const [[ca, sa], [ce, se]] = [state.view.turn, state.view.lift].map((a) => [Math.cos(a), Math.sin(a)]);
    const right = [-sa, ca, 0];
    const towards = [ca * ce, sa * ce, se];
    const up = [-ca * se, -sa * se, ce];
    return { right, up, towards };
  }

  // Points of a raceway across its groove: along the axis and outwards, in the middle of balls that touch at their contact angle.
  function groove(k, angle) {
    const out = k === 0 ? 1 : -1;
    const r = space.grooves[k];
    const centre = [out * (radius - r) * Math.sin(angle), pitch + out * (radius - r) * Math.cos(angle)];
    const points = [];
    for (let i = -4; i <= 4; i += 1) {
      const at = angle + spread * i / 4;
      points.push([centre[0] + out * r * Math.sin(at), centre[1] + out * r * Math.cos(at)]);
    }
    return points;
  }
  function profile(k) {
    const inside = groove(k, space.contact_angle);
    const [first, last] = [inside[0], inside[inside.length - 1]];
    const back = k === 0 ? Math.max(...inside.map((p) => p[1])) + thick : Math.min(...inside.map((p) => p[1])) - thick;
    const [low, high] = [first[0], last[0]].sort((a, b) => a - b);
    return { inside, edge: [[low, back], [high, back]], ends: first[0] < last[0] ? [first, last] : [last, first] };
  }
  const profiles = [profile(0), profile(1)];

  // Two rims and the bars between the pockets.
  function drawCage(face, moves, towards, at) {
    const [half, inside, low, high] = [1.35 * radius, 1.1 * radius, pitch - 0.22 * radius, pitch + 0.22 * radius];
    const at3 = (along, out, angle) => moves([along, out * Math.cos(angle), out * Math.sin(angle)]);
    const strip = (p, q, from, to, tone) =>
      face([at3(...p, from), at3(...q, from), at3(...q, to), at3(...p, to)], tone, "hsl(43, 40%, 42%)", "43, 58%");
    const turned = data.first_angle + between(data.turn, at);
    const steps = 4 * data.count;
    for (let i = 0; i < steps; i += 1) {
      const [from, to] = [i, i + 1].map((k) => turned + TURN * (k + 0.5) / steps);
      const facing = dot([0, Math.cos(from), Math.sin(from)], towards);
      [1, -1].forEach((side) => {
        strip([side * half, high], [side * inside, high], from, to, 66 + 14 * facing);
        strip([side * half, low], [side * inside, low], from, to, 60 - 10 * facing);
        strip([side * half, low], [side * half, high], from, to, 70);
        strip([side * inside, low], [side * inside, high], from, to, 56);
      });
    }
    const width = Math.max(Math.PI / data.count - 1.08 * radius / pitch, 0.1 * Math.PI / data.count);
    for (let j = 0; j < data.count; j += 1) {
      const middle = turned + TURN * (j + 0.5) / data.count;
      const facing = dot([0, Math.cos(middle), Math.sin(middle)], towards);
      strip([-inside, high], [inside, high], middle - width, middle + width, 66 + 14 * facing);
      strip([-inside, low], [inside, low], middle - width, middle + width, 60 - 10 * facing);
    }
  }

  function draw(at) {
    const size = Math.max(canvas.clientWidth, 200);
    const ratio = Math.max(2, window.devicePixelRatio || 1);
    canvas.width = Math.round(size * ratio);
    canvas.height = canvas.width;
    const on = canvas.getContext("2d", { willReadFrequently: true });
    on.fillStyle = "#fff";
    on.fillRect(0, 0, canvas.width, canvas.height);
    const reach = pitch + radius + 2 * thick;
    const scale = 0.5 * canvas.width / (1.1 * reach);
    const { right, up, towards } = camera();
    const px = (p) => [0.5 * canvas.width + scale * dot(p, right), 0.5 * canvas.height - scale * dot(p, up)];
    const m = state.magnification;
    // Small angles: p + (0, a, b) x p.
    const moved = (at) => {
      const [x, y, z, a, b] = at.map((value) => m * value);
      return ([along, p, q]) => sum([x, y, z], [along + a * q - b * p, p + b * along, q - a * along]);
    };
    const [, y, z] = displaced(at).map((value) => m * value);
    const tilted = moved(displaced(at));
    const list = [];
    const face = (points, tone, line, hue = "212, 14%") => {
      const depth = points.reduce((all, p) => all + dot(p, towards), 0) / points.length;
      list.push({ depth, paint: () => {
        on.beginPath();
        points.forEach((p, i) => (i ? on.lineTo(...px(p)) : on.moveTo(...px(p))));
        on.closePath();
        on.fillStyle = `hsl(${hue}, ${tone}%)`;
        on.fill();
        on.strokeStyle = line ?? on.fillStyle;
        on.lineWidth = 0.6 * ratio;
        on.stroke();
      } });
    };
    const parts = 60;
    const place = (k, [along, out], angle) => {
      const p = [along, out * Math.cos(angle), out * Math.sin(angle)];
      return k === 1 ? tilted(p) : p;
    };
    profiles.forEach(({ inside, edge, ends }, k) => {
      const shown = (angle) => dot([0, Math.cos(angle), Math.sin(angle)], towards) < (k === 0 ? 0.12 : 2);
      for (let i = 0; i < parts; i += 1) {
        const [from, to] = [TURN * i / parts, TURN * (i + 1) / parts];
        if (!shown(0.5 * (from + to))) continue;
        const facing = dot([0, Math.cos(from), Math.sin(from)], towards);
        const band = (p, q, tone) => face([place(k, p, from), place(k, q, from), place(k, q, to), place(k, p, to)], tone);
        const light = k === 0 ? -facing : facing;
        for (let n = 0; n + 1 < inside.length; n += 1) band(inside[n], inside[n + 1], 70 + 14 * light);
        band(edge[0], edge[1], 62);
        band(ends[0], edge[0], 78);
        band(ends[1], edge[1], 78);
      }
    });
    if (space.cage) drawCage(face, moved(ofCage(at)), towards, at);
    const overlay = [];
    const angles = [];
    for (let j = 0; j < data.count; j += 1) {
      const angle = data.first_angle + TURN * j / data.count + between(data.turn, at) + between(data.ahead, at, j);
      const [ahead, outwards] = [[0, -Math.sin(angle), Math.cos(angle)], [0, Math.cos(angle), Math.sin(angle)]];
      const centre = times(outwards, pitch);
      angles.push(centre);
      list.push({ depth: dot(centre, towards), paint: () => {
        const [cx, cy] = px(centre);
        const shade = on.createRadialGradient(cx - 0.35 * scale * radius, cy - 0.4 * scale * radius, 0.1 * scale * radius, cx, cy, scale * radius);
        shade.addColorStop(0, "#fff");
        shade.addColorStop(1, j ? "#aeb6bf" : colors.first);
        on.beginPath();
        on.arc(cx, cy, scale * radius, 0, TURN);
        on.fillStyle = shade;
        on.fill();
        on.strokeStyle = colors.muted;
        on.lineWidth = 0.8 * ratio;
        on.stroke();
      } });
      const local = (along, out, round) => sum(times([1, 0, 0], along), sum(times(outwards, out), times(ahead, round)));
      const line = (p, q, color, width) => overlay.push(() => {
        on.beginPath();
        on.moveTo(...px(p));
        on.lineTo(...px(q));
        on.strokeStyle = color;
        on.lineWidth = width * ratio;
        on.stroke();
      });
      [[data.forces.outer, space.angles[0], 1], [data.forces.inner, space.angles[1], -1]].forEach(([force, packed, side]) => {
        if (!force || !packed) return;
        const [load, contact] = [reached(force, at, j), between(packed, at, j)];
        if (!(load > 0) || !(state.arrows > 0)) return;
        const normal = local(side * Math.sin(contact), side * Math.cos(contact), 0);
        const width = Math.min(0.6 + 4 * state.arrows * load / scales.raceway, 9);
        line(sum(centre, times(normal, 0.15 * radius)), sum(centre, times(normal, radius)), colors.raceway, width);
      });
      if (space.axes) {
        const [pitched, yawed] = space.axes.map((packed) => Math.tan(between(packed, at, j)));
        const axis = local(1, -pitched, -yawed);
        const half = times(axis, 1.35 * radius / Math.sqrt(dot(axis, axis)));
        line(sum(centre, times(half, -1)), sum(centre, half), colors.path, 1.1);
      }
    }
    list.sort((p, q) => p.depth - q.depth).forEach(({ paint }) => paint());
    overlay.forEach((paint) => paint());
    return { m, shown: radius, outer: pitch + radius, inner: pitch - radius, ring: [y, z], bounds: [], elements: angles.map((centre) => ({ centre })) };
  }

  // Drag to turn; a double click shows it as at first.
  state.view = { turn: 0.6, lift: 0.35 };
  function turnable(show) {
    let last = null;
    canvas.style.touchAction = "none";
    canvas.style.cursor = "grab";
    canvas.addEventListener("pointerdown", (event) => {
      last = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!last) return;
      state.view.turn -= 0.008 * (event.clientX - last[0]);
      state.view.lift = Math.min(Math.max(state.view.lift + 0.008 * (event.clientY - last[1]), -1.5), 1.5);
      last = [event.clientX, event.clientY];
      show();
    });
    canvas.addEventListener("pointerup", () => { last = null; });
    canvas.addEventListener("dblclick", () => {
      state.view = { turn: 0.6, lift: 0.35 };
      show();
    });
  }

  // Least and largest contact angle of the loaded contacts of a race, degrees.
  function angleRange(k, at) {
    const [force, packed] = [[data.forces.outer, data.forces.inner][k], space.angles[k]];
    if (!force || !packed) return null;
    let [low, high] = [Infinity, -Infinity];
    for (let j = 0; j < data.count; j += 1) {
      if (!(reached(force, at, j) > 0)) continue;
      const angle = between(packed, at, j) * 360 / TURN;
      [low, high] = [Math.min(low, angle), Math.max(high, angle)];
    }
    return high < low ? null : [low, high];
  }

  return { draw, limits, turnable, displaced, angleRange };
}
