// Rollers in space around the unrolled circumference at any time, between the lines of their ribs: turned by their skew as seen from
// outside, and by their tilt as seen along the orbit.
function unrolled(data, state, { between, colors }) {
  const TURN = 2 * Math.PI;
  const canvas = document.getElementById("unrolled");
  canvas.hidden = false;
  const { length, face_radius: face, end_play: play, ribs, motion } = data.unrolled;
  const [radius, around] = [data.element_radius, TURN * data.pitch_radius];
  const views = [["skew", "seen from outside"], ["tilt", "seen along the orbit, outwards to the right"]];
  // Height of a view, m.
  const high = 1.5 * length;

  // The largest skew, and the largest tilt, of any roller in any frame is drawn as a quarter of a right angle, if neighbours leave room
  // for that.
  const free = 0.5 * (around / data.count - 2 * radius) / (0.5 * length);
  const factors = motion.slice(1).map((packed) => {
    const most = packed.values.reduce((max, x) => Math.max(max, Math.abs(packed.unit * x)), 0);
    const wanted = most > 0 ? Math.min(0.39, 1.5 * free) / most : 1;
    const digit = 10 ** Math.floor(Math.log10(wanted));
    return Math.max(Math.floor(wanted / digit) * digit, 1);
  });
  const [factor] = factors;

  // Corners of a roller in its own middle: across, and along its axis; its ends are rounded up to their faces.
  const [half, edge] = [0.5 * length, Math.min(radius - face, 0.2 * length)];
  const shape = [[face, half], [radius, half - edge], [radius, edge - half], [face, -half], [-face, -half], [-radius, edge - half], [-radius, half - edge], [-face, half]];
  // Small angles grow in proportion, so that a corner that touches a rib does so in the picture.
  const turned = ([across, along], angle) => [across + angle * along, along - angle * across];

  function places(at) {
    const list = [];
    for (let j = 0; j < data.count; j += 1) {
      const angle = data.first_angle + TURN * j / data.count + between(data.turn, at) + between(data.ahead, at, j);
      const [offset, skew, tilt] = motion.map((packed, k) => (k === 2 ? factors[1] : factor) * between(packed, at, j));
      const middle = ((angle % TURN) + TURN) % TURN / TURN * around;
      // Seen from outside the end at +x goes back where the skew is positive.
      list.push({ j, middle, offset, angles: [-skew, tilt] });
    }
    return list;
  }
  const points = ({ middle, offset, angles }, view) =>
    shape.map((p) => turned(p, angles[view])).map(([across, along]) => [middle + across, offset + along]);

  function draw(at) {
    const width = Math.max(canvas.clientWidth, 200);
    const ratio = Math.max(2, window.devicePixelRatio || 1);
    const label = 16;
    canvas.width = Math.round(width * ratio);
    const margin = 66 * ratio;
    const scale = (canvas.width - margin - 8 * ratio) / around;
    const strip = scale * high + 2 * label * ratio;
    canvas.height = Math.round(2 * strip + 8 * ratio);
    canvas.style.height = `${canvas.height / ratio}px`;
    const on = canvas.getContext("2d", { willReadFrequently: true });
    on.fillStyle = "#fff";
    on.fillRect(0, 0, canvas.width, canvas.height);
    on.font = `${11 * ratio}px sans-serif`;
    on.textBaseline = "middle";
    const text = (what, x, y, align, color = colors.muted) => {
      on.textAlign = align;
      on.fillStyle = color;
      on.fillText(what, x, y);
    };
    const list = places(at);
    views.forEach(([name, seen], view) => {
      const zero = view * strip + label * ratio + 0.5 * scale * high;
      const px = ([across, along]) => [margin + scale * across, zero - scale * along];
      text(`${name}, ${factors[view]} times as large, ${seen}`, margin, view * strip + 0.6 * label * ratio, "left", colors.ink);
      on.save();
      on.beginPath();
      on.rect(margin, view * strip + label * ratio, scale * around, scale * high);
      on.clip();
      // Ribs as far from the middle as rollers have room for, with their magnified play.
      ribs.forEach(([, side]) => {
        const line = side * (half + 0.5 * factor * (play ?? 0));
        const y = px([0, line])[1];
        on.fillStyle = colors.ring;
        on.fillRect(margin, side > 0 ? y - 5 * ratio : y, scale * around, 5 * ratio);
      });
      list.forEach((roller) => {
        // One at the beginning is seen at the end, too.
        [-around, 0, around].forEach((shift) => {
          on.beginPath();
          points(roller, view).forEach(([across, along], i) => {
            const p = px([across + shift, along]);
            if (i) on.lineTo(...p);
            else on.moveTo(...p);
          });
          on.closePath();
          on.fillStyle = roller.j ? colors.metal : colors.first;
          on.fill();
          on.strokeStyle = colors.ink;
          on.lineWidth = 0.9 * ratio;
          on.stroke();
          const [x, y] = px([roller.middle + shift, roller.offset]);
          text(String(roller.j), x, y, "center");
        });
      });
      on.restore();
      [1, -1].forEach((side) => {
        const there = ribs.filter((rib) => rib[1] === side).map((rib) => rib[0]);
        if (!there.length) return;
        const y = px([0, side * (half + 0.5 * factor * (play ?? 0))])[1];
        text(there.length > 1 ? "ribs" : `${there[0]} rib`, margin - 6 * ratio, y, "right");
      });
      text("+x", margin - 6 * ratio, zero, "right");
      for (let k = 0; k <= 8; k += 1) {
        const x = px([k / 8 * around, 0])[0];
        text(`${45 * k}\u00b0`, Math.min(x, canvas.width - 14 * ratio), (view + 1) * strip - 0.5 * label * ratio, "center");
      }
    });
  }

  // Largest skew and tilt at a time with their rollers.
  function largest(at) {
    return ["skew", "tilt"].map((name, k) => {
      let [found, which] = [0, 0];
      for (let j = 0; j < data.count; j += 1) {
        const x = between(motion[k + 1], at, j);
        if (Math.abs(x) > Math.abs(found)) [found, which] = [x, j];
      }
      return [name, found, which];
    });
  }
  const corners = (at) => places(at).flatMap((roller) => [...points(roller, 0), ...points(roller, 1)].flat());

  return { draw, factors, largest, corners };
}
