(() => {
  const root = document.documentElement;
  window.onerror = (message) => { root.dataset.error = String(message); };

  // In print everything is open.
  const folded = document.querySelectorAll("details");
  let opened = [];
  window.addEventListener("beforeprint", () => {
    opened = [...folded].filter((part) => !part.open);
    opened.forEach((part) => { part.open = true; });
  });
  window.addEventListener("afterprint", () => opened.forEach((part) => { part.open = false; }));

  const source = document.getElementById("motion");
  if (!source) {
    root.dataset.selfcheck = location.hash.includes("selfcheck") ? "ok, no animation" : "";
    return;
  }
  const TURN = 2 * Math.PI;
  const data = JSON.parse(source.textContent);
  const element = (id) => document.getElementById(id);
  const state = { at: 0, playing: false, slower: 100, magnification: 1, arrows: 1, last: null };
  const {
    colors, frames, radius, clearance, farthest, scales, limits, canvas, between, reached, shapes, centreAt, drawBearing, drawOrbit,
    plain, force,
  } = bearing(data, state);
  const spatial = data.space ? inSpace(data, state, { between, reached, scales, colors, canvas }) : null;
  if (spatial) Object.assign(limits, spatial.limits);
  const lying = data.unrolled ? unrolled(data, state, { between, colors }) : null;
  const time = (at) => {
    const first = Math.min(Math.floor(at), frames - 2);
    return data.times[first] + (at - first) * (data.times[first + 1] - data.times[first]);
  };

  // ---- Texts ----

  const digits = (x, n) => (Number(x.toFixed(n)) || 0).toFixed(n).replace("-", "\u2212");
  const round = (x) => plain(x, 2);

  function largestNow(packed, at) {
    let [most, which] = [0, 0];
    for (let j = 0; j < data.count; j += 1) {
      const x = Math.abs(reached(packed, at, j));
      if (x > most) [most, which] = [x, j];
    }
    return most > 0 ? `${force(most)}, ${data.kind} ${which}` : "none";
  }

  const places = Math.max(0, Math.ceil(-Math.log10(data.times[1] - data.times[0])));

  function readout(at) {
    const rows = [["time", `${digits(time(at), places)} s`], ["frame", `${digits(at + 1, Number.isInteger(at) ? 0 : 1)} of ${frames}`]];
    if (data.cage) {
      const [y, z] = centreAt(at);
      const of = clearance ? "" : " mm";
      rows.push([clearance ? "cage centre y / clearance" : "cage centre y", digits(y, 3) + of]);
      rows.push([clearance ? "cage centre z / clearance" : "cage centre z", digits(z, 3) + of]);
      rows.push([clearance ? "eccentricity" : "distance", digits(Math.hypot(y, z), 3) + of]);
      rows.push(["turns of the cage", digits(between(data.turn, at) / TURN, 3)]);
    }
    if (data.forces.guide) rows.push(["guide force", force(Math.hypot(...data.forces.guide.map((p) => reached(p, at))))]);
    if (data.forces.pocket) rows.push(["largest pocket force", largestNow(data.forces.pocket, at)]);
    if (spatial) {
      ["outer", "inner"].forEach((race, k) => {
        const range = spatial.angleRange(k, at);
        if (range) rows.push([`contact angles, ${race} race`, `${digits(range[0], 1)} to ${digits(range[1], 1)} deg`]);
      });
      const [x, y, z, a, b] = spatial.displaced(at);
      rows.push(["inner ring x, y, z", `${[x, y, z].map((v) => digits(1e6 * v, 2)).join(", ")} \u00b5m`]);
      rows.push(["tilt about y, z", `${[a, b].map((v) => digits(1e3 * v, 3)).join(", ")} mrad`]);
    }
    if (lying) {
      lying.largest(at).forEach(([name, x, j]) => rows.push([`largest ${name}`, `${digits(1e3 * x, 2)} mrad, roller ${j}`]));
    }
    if (data.forces.inner) rows.push(["largest on the inner raceway", largestNow(data.forces.inner, at)]);
    if (data.forces.outer) rows.push(["largest on the outer raceway", largestNow(data.forces.outer, at)]);
    const body = element("readout").tBodies[0];
    body.replaceChildren(...rows.map((cells) => {
      const row = document.createElement("tr");
      cells.forEach((text) => { row.insertCell().textContent = text; });
      return row;
    }));
  }

  function legend() {
    const items = [];
    if (scales.raceway > 0 && !spatial) items.push([colors.raceway, "normal forces on the raceways, at the records"]);
    if (spatial) {
      items.push([colors.raceway, "normals of loaded contacts, the thicker the larger the force, at the records"]);
      items.push([colors.path, "axes about which balls turn against the train"]);
      items.push([colors.first, "ball 0, the others follow from y to z; drag to turn the bearing, double click to turn it back"]);
    }
    if (data.forces.pocket) {
      const which = data.forces.pocket_of_steps ? "largest in any step since the frame before" : "at the records";
      items.push([colors.pocket, `pocket forces on the cage, along the circumference, ${which}`]);
    }
    if (data.forces.guide) items.push([colors.guide, "guide force on the cage, at the records"]);
    if (!spatial && (scales.cage > 0 || scales.raceway > 0)) items.push([null, "two heads: the arrow is cut"]);
    if (!spatial) items.push([colors.first, `${data.kind} 0, the others follow counter-clockwise; radial lines: spin marks`]);
    element("legend").replaceChildren(...items.map(([color, text]) => {
      const item = document.createElement("li");
      const patch = document.createElement("b");
      if (color) patch.style.background = color;
      item.append(patch, text);
      return item;
    }));
    element("orbit-text").textContent = !data.cage ? "" : clearance
      ? "Cage centre in the guide clearance (circle); y to the right, z upwards."
      : `Cage centre, y to the right, z upwards; the path goes out to ${digits(farthest, 3)} mm.`;
    if (lying) {
      element("unrolled-text").textContent = `Above: rollers around the bearing, from y counter-clockwise to the right, seen from outside, turned by their skew. Below: the same rollers seen along the orbit, turned by their tilt, outwards to the right. +x is up. Skew, place along the axis and end play are drawn ${round(lying.factors[0])} times as large as they are, tilt ${round(lying.factors[1])} times.`;
    }
  }

  function caption(s) {
    if (spatial) {
      element("caption").textContent = `Displacements and tilts of the inner ring${data.space.cage ? " and the cage" : ""} are drawn ${round(s.m)} times as large as they are; balls stand on the pitch circle. The outer ring is cut open towards the viewer. Width and thickness of the rings are not of the scene.`;
      return;
    }
    const smaller = s.shown < 0.995 * radius ? `, but ${data.kind}s, to leave room for that, with ${Math.round(100 * s.shown / radius)} % of their size` : "";
    const rollers = data.raceways_known
      ? " Rollers are drawn in touch with the outer raceway, as their radial place is not recorded; gaps to the inner one show the play, overlaps the elastic approach of both contacts."
      : " The scene has no raceways: the rings are drawn as if they touched the elements.";
    const height = data.cage ? " Height of the cage and thickness of the rings are not of the scene." : "";
    element("caption").textContent = `Clearances and displacements are drawn ${round(s.m)} times as large as they are; bodies are to scale${smaller}.${rollers}${height}`;
  }

  // ---- Controls ----

  function show() {
    const s = spatial ? spatial.draw(state.at) : drawBearing(state.at);
    drawOrbit(state.at);
    if (lying) lying.draw(state.at);
    readout(state.at);
    caption(s);
    element("time").value = state.at;
  }

  function play(on) {
    state.playing = on;
    state.last = null;
    if (on && state.at >= frames - 1) state.at = 0;
    element("play").textContent = on ? "Pause" : "Play";
    if (on) window.requestAnimationFrame(tick);
  }

  // To the next frame, or the one before.
  function step(way) {
    play(false);
    const next = way > 0 ? Math.floor(state.at + 1e-9) + 1 : Math.ceil(state.at - 1e-9) - 1;
    state.at = Math.min(Math.max(next, 0), frames - 1);
    show();
  }

  // Moves on by the time since the last call.
  function tick(now) {
    if (!state.playing) return;
    const passed = state.last === null ? 0 : Math.min(now - state.last, 250) / 1000;
    state.last = now;
    const span = data.times[frames - 1] - data.times[0];
    state.at = Math.min(state.at + passed / state.slower * (frames - 1) / span, frames - 1);
    show();
    if (state.at >= frames - 1) play(false);
    else window.requestAnimationFrame(tick);
  }

  function magnify(m) {
    state.magnification = Math.min(Math.max(m, limits.low), limits.high);
    element("magnify").value = Math.log(state.magnification) / Math.log(limits.high || 1) || 0;
    element("magnify-text").textContent = `${round(state.magnification)} times`;
  }

  const slowest = 10 ** 4.5;
  function slow(factor) {
    state.slower = Math.min(Math.max(factor, 1), slowest);
    element("speed").value = 1 - Math.log(state.slower) / Math.log(slowest);
    element("speed-text").textContent = state.slower < 1.05 ? "real time" : `1 : ${round(state.slower)}`;
  }

  function lengthen(factor) {
    state.arrows = factor;
    element("arrows").value = factor;
    element("arrows-text").textContent = factor > 0 ? `${digits(factor, 1)} times` : "none";
  }

  element("time").max = frames - 1;
  element("play").addEventListener("click", () => play(!state.playing));
  element("back").addEventListener("click", () => step(-1));
  element("forward").addEventListener("click", () => step(1));
  document.addEventListener("keydown", (event) => {
    if (event.key === "," || event.key === ".") step(event.key === "." ? 1 : -1);
  });
  element("time").addEventListener("input", (event) => {
    play(false);
    state.at = Number(event.target.value);
    show();
  });
  element("speed").addEventListener("input", (event) => slow(slowest ** (1 - Number(event.target.value))));
  element("magnify").addEventListener("input", (event) => {
    magnify(limits.high ** Number(event.target.value));
    show();
  });
  element("arrows").addEventListener("input", (event) => {
    lengthen(Number(event.target.value));
    show();
  });
  window.addEventListener("resize", show);
  window.addEventListener("beforeprint", () => {
    play(false);
    show();
  });

  // A turn of the cage in about six seconds.
  const turned = Math.abs(between(data.turn, frames - 1) - between(data.turn, 0));
  const length = data.times[frames - 1] - data.times[0];
  slow(turned > 0.1 ? 6 * turned / TURN / length : 10 / length);
  magnify(limits.usual);
  lengthen(1);
  legend();
  if (spatial) spatial.turnable(show);

  // "#t=0.05" shows that time, "#m=8" magnifies so many times, "#selfcheck" tries everything.
  const asked = new URLSearchParams(location.hash.slice(1));
  const goTo = (t) => {
    const next = data.times.findIndex((x) => x >= t);
    const high = next < 0 ? frames - 1 : Math.max(next, 1);
    const share = (t - data.times[high - 1]) / (data.times[high] - data.times[high - 1]);
    state.at = Math.min(Math.max(high - 1 + share, 0), frames - 1);
  };
  if (asked.has("m")) magnify(Number(asked.get("m")) || limits.usual);
  if (asked.has("t")) goTo(Number(asked.get("t")) || 0);
  show();

  function check() {
    const expect = (holds, what) => { if (!holds) throw new Error(what); };
    const sum = () => {
      const { width, height } = canvas;
      const pixels = canvas.getContext("2d", { willReadFrequently: true }).getImageData(0, 0, width, height).data;
      let all = 0;
      for (let i = 0; i < pixels.length; i += 4) all = (31 * all + 65536 * pixels[i] + 256 * pixels[i + 1] + pixels[i + 2]) % 2147483647;
      return all;
    };
    const set = (id, value) => {
      element(id).value = value;
      element(id).dispatchEvent(new Event("input"));
    };
    expect(root.scrollWidth <= root.clientWidth, `the page is ${root.scrollWidth - root.clientWidth} px wider than the window`);
    set("time", 0);
    const start = sum();
    element("play").click();
    expect(state.playing && element("play").textContent === "Pause", "play does not play");
    for (let i = 0; i < 20; i += 1) tick(40 * i);
    expect(state.at > 0, "playing does not move on");
    expect(sum() !== start, "playing shows the same picture");
    element("play").click();
    expect(!state.playing, "pause does not pause");
    const paused = state.at;
    tick(1e6);
    expect(state.at === paused, "it moves while it is paused");
    set("time", 0.5);
    element("forward").click();
    expect(state.at === 1, "the next frame is another");
    element("back").click();
    expect(state.at === 0, "the frame before is another");
    element("back").click();
    expect(state.at === 0, "there is a frame before the first");
    set("time", frames - 1);
    expect(readText().startsWith(digits(data.times[frames - 1], places)), "the end shows another time");
    set("time", (frames - 1) / 2);
    const usual = sum();
    set("magnify", 0);
    expect(state.magnification === limits.low, "the magnification does not follow");
    expect(limits.high === limits.low || sum() !== usual, "the magnification changes nothing");
    set("magnify", 1);
    magnify(limits.usual);
    set("speed", 1);
    expect(state.slower < 1.05, "the speed does not follow");
    set("arrows", 0);
    lengthen(1);
    slow(100);
    show();
    expect(sum() === usual, "the same settings show another picture");
    if (lying) {
      const painted = document.getElementById("unrolled");
      expect(!painted.hidden && painted.width > 0, "rollers are not unrolled");
      for (let i = 0; i < frames; i += Math.ceil(frames / 40)) {
        expect(lying.corners(i).every(Number.isFinite), `frame ${i} has rollers that lie nowhere`);
      }
    }
    if (spatial) {
      state.view.turn += 0.3;
      show();
      expect(sum() !== usual, "it does not turn");
    }
    for (let i = 0; i < frames; i += Math.ceil(frames / 40)) {
      const s = spatial ? spatial.draw(i) : shapes(i);
      const numbers = [s.shown, s.outer, s.inner, ...s.ring, ...s.bounds, ...s.elements.flatMap((e) => e.centre)];
      expect(numbers.every(Number.isFinite), `frame ${i} has places that are no numbers`);
    }
  }
  const readText = () => element("readout").rows[0].cells[1].textContent;
  if (asked.has("selfcheck")) {
    try {
      check();
      root.dataset.selfcheck = `ok, ${frames} frames`;
    } catch (error) {
      root.dataset.selfcheck = `failed: ${error.message}`;
    }
  }
})();
