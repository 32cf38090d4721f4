// Values, zoom, series on and off. What is drawn is the data: places are read from the SVG, axes from data-figure.
(() => {
const { abs, floor, log10, max, min } = Math;
const all = (e, what) => [...e.querySelectorAll(what)], path = e => e.getAttribute("d");
const clamp = (x, a, b) => min(max(x, min(a, b)), max(a, b));
const number = (e, key) => +e.getAttribute(key);
const set = (e, attributes) => { for (const key in attributes) e.setAttribute(key, attributes[key]); return e; };
const drawn = (name, look, svg) =>
  svg.appendChild(set(document.createElementNS(svg.namespaceURI, name), { class: look, visibility: "hidden" }));
const written = (name, words, parent) => parent.appendChild(Object.assign(document.createElement(name), { textContent: words }));
const on = (e, names, act) => names.split(" ").forEach(name => e.addEventListener(name, act));
const power = n => "10" + [..."" + n].map(c => c == "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]).join("");

// As many digits as the step deserves.
const shown = (v, step) => {
  if (abs(v) < step / 1e3) return "0";
  const size = floor(log10(abs(v)));
  return (size < -4 || size > 6 ? (v / 10 ** size).toFixed(2) + "×" + power(size)
    : v.toFixed(clamp(-floor(log10(step) + 1e-9), 0, 20))).replace("-", "−");
};

// An axis between two places. A place is where something stands in the whole figure; `moved` is where it stands now.
const axis = ([lo, hi, log, label], from, to) => {
  const units = p => lo + (p - from) / (to - from) * (hi - lo), valueAt = u => log ? 10 ** u : u;
  const a = {
    now: [from, to],
    moved: p => from + (p - a.now[0]) / (a.now[1] - a.now[0]) * (to - from),
    value: p => valueAt(units(p)),
    at: v => from + ((log ? log10(v) : v) - lo) / (hi - lo) * (to - from),
    shown: p => {
      const span = abs(units(a.now[1]) - units(a.now[0]));
      return `${label}: ${shown(a.value(p), log ? a.value(p) * min(span, 1) / 200 : span / 500)}`;
    },
    zoom: (...ends) => {
      const now = ends.map(q => clamp(a.now[0] + (q - from) / (to - from) * (a.now[1] - a.now[0]), from, to));
      if (abs(now[1] - now[0]) > 1) a.now = now;
    },
    closer: (middle, factor) => a.zoom(middle + (from - middle) * factor, middle + (to - middle) * factor),
    home: () => { a.now = [from, to]; },
    ticks: () => {
      const ends = a.now.map(units), decades = log && ends[1] - ends[0] > 1, [least, most] = decades ? ends : ends.map(valueAt);
      const raw = (most - least) / 6, unit = 10 ** floor(log10(raw)), out = [];
      const step = decades ? Math.ceil(raw) : unit * [1, 2, 5, 10].find(f => f * unit > raw);
      for (let v = Math.ceil(least / step) * step; v <= most; v += step)
        out.push([a.moved(a.at(decades ? 10 ** v : v)), decades ? power(v) : shown(v, step)]);
      return out;
    },
  };
  return a;
};

// The bar of a histogram has no path.
const markerPlace = e => e.tagName == "circle" ? [number(e, "cx"), number(e, "cy")]
  : /[a-y]/.test(path(e) || "") && path(e).match(/[\d.]+/g);

// The points of a series, with the places of the ends of their error bars.
const pointsOf = (group, zero) => {
  const bars = {}, out = [], add = (x, y) => out.push({ x: +x, y: +y, bar: bars[+x] });
  for (const e of group.children) {
    const d = path(e), place = markerPlace(e);
    let x;
    if (place) add(...place);
    else if (e.tagName == "rect") {
      const y = number(e, "y"), end = y + number(e, "height");
      add(number(e, "x") + number(e, "width") / 2, end > zero + 0.1 ? end : y);
    } else if (e.matches(".error")) for (const [, at, ...ends] of d.matchAll(/M([\d.]+),([\d.]+)V([\d.]+)/g)) bars[+at] = ends;
    else
      for (const [, c, list] of d.matchAll(/([MHV])([^MHV]*)/g))
        if (c == "H") x = list;
        else if (c == "V") add(x, list);
        else for (const pair of list.split(" ")) add(x = pair.split(",")[0], pair.split(",")[1]);
  }
  return out;
};

all(document, "figure[data-figure]").forEach(figure => {
  const about = JSON.parse(figure.dataset.figure), svg = figure.querySelector("svg"), find = c => svg.querySelector(c);
  const groups = all(svg, ".series"), plot = find(".plot"), [left, top] = [number(plot, "x"), number(plot, "y")];
  if (!groups.length) return;
  const right = left + number(plot, "width"), bottom = top + number(plot, "height");
  const X = axis(about.x, left, right), Y = axis(about.y, bottom, top), zero = about.y[2] ? bottom : Y.at(0);
  const series = about.series.filter(s => s.drawn).map((s, i) => ({ ...s, group: groups[i], points: pointsOf(groups[i], zero) }));
  const readout = set(written("output", "", figure), { class: "readout" });
  const ring = set(drawn("circle", "point", svg), { r: 7 }), stretch = drawn("rect", "stretch", svg);
  groups[0].parentNode.prepend(...all(svg, ".band"));
  const [xTicks, yTicks, grid, axes] = [".x-ticks", ".y-ticks", ":scope > [stroke='#d4d4d4']", ":scope > path[stroke='#444']"].map(find);
  const was = [xTicks.innerHTML, yTicks.innerHTML, grid && path(grid), path(axes)];
  // [series, point] that is read; where a drag began.
  let at = null, start = null;

  const point = () => at && series[at[0]].points[at[1]], placeOf = p => [X.moved(p.x), Y.moved(p.y)];
  const inPlot = ([x, y]) => x > left - 1 && x < right + 1 && y > top - 1 && y < bottom + 1;
  const scale = () => svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
  const show = now => {
    at = now;
    const p = point(), [x, y] = p ? placeOf(p) : [];
    if (!p || series[at[0]].off || !inPlot([x, y])) at = null;
    set(ring, at ? { visibility: "visible", cx: x, cy: y } : { visibility: "hidden" });
    readout.textContent = "";
    if (!at) return;
    const [down, up] = (p.bar || []).map(b => abs(Y.value(b) - Y.value(p.y))).map(e => shown(e, e / 50));
    const sigma = !up ? "" : up == down ? ` ± ${up}` : ` + ${up} − ${down}`;
    readout.textContent = [series[at[0]].name, X.shown(p.x), Y.shown(p.y) + sigma].join("\n");
    const wide = readout.offsetWidth, beside = x * scale() + 14;
    readout.style.left = `${max(beside + wide > svg.clientWidth ? beside - 28 - wide : beside, 0)}px`;
    readout.style.top = `${max(y * scale() - readout.offsetHeight - 8, 0)}px`;
  };
  const nearest = (x, y, only) => {
    let best = Infinity, found = null;
    series.forEach((s, i) => s.off || (only ?? i) != i || s.points.forEach((p, k) => {
      const [px, py] = placeOf(p), distance = Math.hypot(px - x, only == null ? py - y : 0);
      if (distance < best && inPlot([px, py])) { best = distance; found = [i, k]; }
    }));
    show(found);
  };

  const redraw = () => {
    const zoomed = X.now + "," + Y.now != [left, right, bottom, top], sx = (X.moved(right) - X.moved(left)) / (right - left);
    const sy = (Y.moved(bottom) - Y.moved(top)) / (bottom - top), matrix = (s, y) => `matrix(${sx},0,0,${s},${X.moved(0)},${y})`;
    svg.classList.toggle("zoomed", zoomed);
    for (const band of all(svg, ".band")) set(band, { transform: matrix(1, 0) });
    for (const e of all(svg, ".series > *")) {
      const p = markerPlace(e);
      set(e, { transform: p ? `translate(${X.moved(p[0]) - p[0]},${Y.moved(p[1]) - p[1]})` : matrix(sy, Y.moved(0)) });
    }
    const xs = X.ticks(), ys = Y.ticks();
    const label = (words, x, y, end) => `<text x="${x}" y="${y}" font-size="16" text-anchor="${end}">${words}</text>`;
    const lines = (a, b) => xs.map(([p]) => `M${p},${bottom}${a}`).join("") + ys.map(([p]) => `M${left},${p}${b}`).join("");
    xTicks.innerHTML = zoomed ? xs.map(([p, t]) => label(t, p, bottom + 23, "middle")).join("") : was[0];
    yTicks.innerHTML = zoomed ? ys.map(([p, t]) => label(t, left - 10, p + 5.5, "end")).join("") : was[1];
    grid?.setAttribute("d", zoomed ? lines("V" + top, "H" + right) : was[2]);
    axes.setAttribute("d", zoomed ? lines("v6", "h-6") : was[3]);
    show(at);
  };
  const home = () => { X.home(); Y.home(); redraw(); };

  const spot = event => {
    const { x, y } = svg.getBoundingClientRect();
    return [(event.clientX - x) / scale(), (event.clientY - y) / scale()];
  };
  const stop = () => { start = null; set(stretch, { visibility: "hidden", width: 0 }); };
  on(svg, "pointerdown", event => { if (!event.button && inPlot(spot(event))) start = spot(event); });
  on(svg, "pointermove", event => {
    const now = spot(event);
    if (!start) return inPlot(now) && nearest(...now);
    svg.setPointerCapture(event.pointerId);
    const x = clamp(now[0], left, right), y = clamp(now[1], top, bottom), tall = abs(y - start[1]);
    set(stretch, { visibility: "visible", x: min(x, start[0]), width: abs(x - start[0]),
      ...tall > 30 ? { y: min(y, start[1]), height: tall } : { y: top, height: bottom - top } });
  });
  on(svg, "pointerup", () => {
    const [x, y, w, h] = ["x", "y", "width", "height"].map(k => number(stretch, k));
    if (start && w > 8) { X.zoom(x, x + w); Y.zoom(y + h, y); redraw(); }
    stop();
  });
  on(svg, "pointercancel", stop);
  on(svg, "dblclick", home);
  on(svg, "pointerleave blur", () => show(null));

  const along = step => {
    let [i, k] = at ?? [series.findIndex(s => !s.off), -1], p;
    do p = series[i]?.points[k += step]; while (p && !inPlot(placeOf(p)));
    if (p) show([i, k]);
  };
  const across = step => {
    if (!at) return along(1);
    let i = at[0];
    do i = (i + step + series.length) % series.length; while (series[i].off);
    nearest(placeOf(point())[0], 0, i);
  };
  const closer = factor => { X.closer(at ? placeOf(point())[0] : (left + right) / 2, factor); redraw(); };
  const keys = { ArrowRight: () => along(1), ArrowLeft: () => along(-1), ArrowUp: () => across(-1), ArrowDown: () => across(1),
    "+": () => closer(0.5), "-": () => closer(2), Escape: home };
  on(svg, "keydown", event => {
    if (event.target != svg || event.ctrlKey || event.metaKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });

  all(svg, ".legend > g").forEach(entry => {
    entry.append(entry.nextSibling);
    const s = series.find(s => s.name == entry.textContent.trim());
    if (!s || series.length < 2) return;
    set(entry, { role: "button", tabindex: 0, "aria-pressed": true });
    on(entry, "click keydown", event => {
      if (event.key && !"Enter ".includes(event.key)) return;
      event.preventDefault();
      s.off = !s.off;
      s.group.style.display = s.off ? "none" : "";
      set(entry, { "aria-pressed": !s.off });
      show(at);
    });
  });
  set(svg, { role: "group", tabindex: 0 });
  figure.classList.add("live");
});

const fit = () => all(document, ".scroll").forEach(e => e.classList.toggle("fits", e.scrollWidth <= e.clientWidth));
window.onresize = fit;
fit();
})();
