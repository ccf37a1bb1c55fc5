// Zoom, and values at the pointer, in the pictures. Their diagrams are rectangles that tell the axes: "from to lin|log name".
(() => {
  const figures = document.querySelectorAll(".pictures figure");
  if (!figures.length) return;
  document.getElementById("pictures-text").textContent =
    "The pointer shows values, those of a curve where it is near one. Pinch, or Ctrl and the wheel, zooms; then a picture can be dragged.";

  const round = (x, step) => {
    const digits = Math.min(Math.max(Math.ceil(-Math.log10(step)), 0), 20);
    return (Math.abs(x) >= 1e6 || digits > 6 ? x.toExponential(3) : x.toFixed(digits)).replace(/-/g, "\u2212");
  };

  // An axis along pixels `start` to `start + length` of the picture.
  function axis(text, start, length) {
    const [from, to, kind, ...words] = text.split(" ");
    const [, name, unit] = /^(.*?)(?: \[(.*?)\].*)?$/.exec(words.join(" "));
    const [low, size] = [Number(from), Number(to) - Number(from)];
    return (at) => {
      const value = low + size * (at - start) / length;
      const shown = kind === "log" ? (10 ** value).toPrecision(4) : round(value, Math.abs(size) / 2000);
      return `${name} ${shown}${unit && unit !== "1" ? ` ${unit}` : ""}`;
    };
  }

  function diagrams(svg) {
    const curves = [...svg.querySelectorAll("polyline")].filter((curve) => curve.points.length > 2);
    return [...svg.querySelectorAll("rect[data-x]")].map((rect) => {
      const [x, y, w, h] = ["x", "y", "width", "height"].map((name) => Number(rect.getAttribute(name)));
      const inside = (point) => point.x >= x && point.x <= x + w && point.y >= y && point.y <= y + h;
      const points = curves.flatMap((curve) => [...curve.points].filter(inside));
      return { inside, points, across: axis(rect.dataset.x, x, w), up: axis(rect.dataset.y, y + h, -h) };
    });
  }

  for (const figure of figures) {
    const svg = figure.querySelector("svg");
    const frame = document.createElement("div");
    frame.className = "frame";
    svg.replaceWith(frame);
    frame.append(svg);
    const zoom = Panzoom(svg, { contain: "outside", panOnlyWhenZoomed: true, maxScale: 20, touchAction: "pan-y", cursor: "crosshair" });
    const caption = document.createElement("figcaption");
    const values = document.createElement("output");
    caption.append(values);
    for (const [text, title, act] of [["\u2212", "smaller", zoom.zoomOut], ["+", "larger", zoom.zoomIn], ["whole", "the whole picture", zoom.reset]]) {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: text, title });
      button.addEventListener("click", () => act());
      caption.append(button);
    }
    figure.append(caption);
    svg.addEventListener("panzoomchange", (event) => {
      svg.style.touchAction = event.detail.scale > 1 ? "none" : "pan-y";
    });
    frame.addEventListener("wheel", (event) => {
      if (event.ctrlKey || event.metaKey) zoom.zoomWithWheel(event);
    });

    let all = null;
    const dot = document.createElementNS(svg.namespaceURI, "circle");
    for (const [name, value] of [["r", 14], ["fill", "none"], ["stroke", "#b82e3a"], ["stroke-width", 6]]) dot.setAttribute(name, value);
    const hide = () => {
      dot.remove();
      values.textContent = "";
    };
    svg.addEventListener("pointerleave", hide);
    const show = (event) => {
      all ??= diagrams(svg);
      const matrix = svg.getScreenCTM();
      let at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
      const diagram = all.findLast((one) => one.inside(at));
      hide();
      if (!diagram) return;
      const far = (point) => Math.hypot(point.x - at.x, point.y - at.y);
      const nearest = diagram.points.reduce((best, point) => (far(point) < far(best) ? point : best), diagram.points[0] ?? at);
      if (far(nearest) * matrix.a < 12) {
        at = nearest;
        dot.setAttribute("cx", at.x);
        dot.setAttribute("cy", at.y);
        svg.append(dot);
      }
      values.textContent = `${diagram.across(at.x)}, ${diagram.up(at.y)}`;
    };
    svg.addEventListener("pointermove", show);

    if (location.hash.includes("selfcheck")) {
      const box = svg.querySelector("rect[data-x]").getBoundingClientRect();
      show({ clientX: box.x + box.width / 2, clientY: box.y + box.height / 2 });
      if (!/ [−\d.e+]+.*, .* [−\d.e+]+/.test(values.textContent)) throw new Error(`no values at the pointer: ${values.textContent}`);
      hide();
      zoom.zoom(4);
      if (zoom.getScale() !== 4) throw new Error("no zoom");
      setTimeout(() => zoom.reset(), 100);
    }
  }
})();
