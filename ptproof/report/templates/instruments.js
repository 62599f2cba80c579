const TOLERANCE = 1e-11, STEPS_AT_ONCE = 3000, MOST_STEPS = 600000;
const NS = "http://www.w3.org/2000/svg";

// --- Integration: Dormand and Prince's pair of orders 5 and 4, with the error per step under control. ---
const C = [0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1];
const A = [[], [1 / 5], [3 / 40, 9 / 40], [44 / 45, -56 / 15, 32 / 9],
  [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729], [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656],
  [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84]];
const E = [71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40];

// A run from the first of the edges to the last, which lands on each of them; `step` takes one step.
const march = (moving, s, edges, tolerance = TOLERANCE) => {
  let t = edges[0], x = moving.start(s), h = (edges[edges.length - 1] - t) * 1e-6, edge = 1, steps = 0, failed = "";
  let first = moving.rate(t, x, s);
  const path = [[t, ...x]];
  const step = () => {
    while (edge < edges.length && edges[edge] <= t) edge++;
    if (edge >= edges.length || failed) return false;
    if (++steps > MOST_STEPS) failed = `stopped: more than ${MOST_STEPS} steps`;
    const left = edges[edge] - t, lands = h >= left, size = lands ? left : h;
    const k = [first];
    let next = x;
    for (let stage = 1; stage < 7; stage++) {
      next = x.map((value, i) => value + size * A[stage].reduce((sum, a, j) => sum + a * k[j][i], 0));
      k.push(moving.rate(t + C[stage] * size, next, s));
    }
    const error = Math.sqrt(x.reduce((sum, value, i) => {
      const scale = tolerance * (1 + Math.max(Math.abs(value), Math.abs(next[i])));
      return sum + (size * E.reduce((total, e, j) => total + e * k[j][i], 0) / scale) ** 2;
    }, 0) / x.length);
    if (error <= 1) {
      t = lands ? edges[edge] : t + size;
      x = next;
      first = k[6];
      path.push([t, ...x]);
    }
    h = size * (error > 0 ? Math.min(5, Math.max(0.2, 0.9 * error ** -0.2)) : Number.isNaN(error) ? 0.2 : 5);
    if (lands && error <= 1) h = Math.max(h, left);
    if (h < 1e-15 * (Math.abs(t) + Math.abs(edges[edge] ?? t)) + 1e-300) failed = "stopped: the right-hand side is not defined here";
    return true;
  };
  return { step, path, get failed() { return failed; }, get t() { return t; }, get x() { return x; } };
};
const run = (moving, s, edges, tolerance) => {
  const marcher = march(moving, s, edges, tolerance);
  while (marcher.step());
  return marcher;
};

// --- Words ---
const digits = (value) => {
  if (Number.isNaN(value)) return "not defined";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  return String(Number(value.toPrecision(6))).replaceAll("-", "−").replace(/e\+?/, "·10^");
};
const rounded = (slider, value) => slider.integer ? Math.round(value) : Number(value.toPrecision(4));
const PLACES = 400;
const valueAt = (slider, place) => rounded(slider, slider.log
  ? slider.lowest * (slider.highest / slider.lowest) ** (place / PLACES)
  : slider.lowest + (slider.highest - slider.lowest) * place / PLACES);
const placeOf = (slider, value) => PLACES * (slider.log
  ? Math.log(value / slider.lowest) / Math.log(slider.highest / slider.lowest)
  : (value - slider.lowest) / (slider.highest - slider.lowest));

// --- Drawing ---
const element = (name, attributes, parent, words) => {
  const made = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (words !== undefined) made.textContent = words;
  parent?.append(made);
  return made;
};
const ticks = (low, high, log) => {
  if (log) {
    const found = [], first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    for (let n = first; n <= last; n += Math.max(1, Math.ceil((last - first) / 6))) found.push(10 ** n);
    if (found.length > 1) return found;
  }
  const raw = (high - low) / 5, unit = 10 ** Math.floor(Math.log10(raw));
  const size = [1, 2, 5, 10].find((n) => n * unit >= raw) * unit, found = [];
  for (let n = Math.ceil(low / size - 1e-9); n * size <= high * (1 + 1e-12) + 1e-300; n++) found.push(Number((n * size).toPrecision(12)));
  return found;
};
// Axes over a range in x and y, which may be logarithmic; `even` makes units of both equally long.
const axes = (svg, xs, ys, { logX = false, logY = false, even = false, height = 0 } = {}) => {
  const wide = Math.max(svg.parentElement.clientWidth || 480, 200), high = height || Math.min(340, Math.max(220, wide * 0.62));
  const left = 56, right = 12, top = 10, bottom = 28;
  if (even) {
    const scale = Math.max((xs[1] - xs[0]) / (wide - left - right), (ys[1] - ys[0]) / (high - top - bottom));
    const grow = (range, room) => { const more = (room * scale - (range[1] - range[0])) / 2; return [range[0] - more, range[1] + more]; };
    xs = grow(xs, wide - left - right);
    ys = grow(ys, high - top - bottom);
  }
  const to = (value, [low, end], log) => log ? Math.log(value / low) / Math.log(end / low) : (value - low) / (end - low);
  const x = (value) => left + (wide - left - right) * to(value, xs, logX);
  const y = (value) => high - bottom - (high - top - bottom) * to(value, ys, logY);
  svg.replaceChildren();
  svg.setAttribute("viewBox", `0 0 ${wide} ${high}`);
  svg.setAttribute("width", wide);
  svg.setAttribute("height", high);
  for (const value of ticks(...xs, logX)) {
    element("path", { class: "grid", d: `M${x(value)} ${top}V${high - bottom}` }, svg);
    element("text", { x: x(value), y: high - bottom + 16, "text-anchor": "middle" }, svg, digits(value));
  }
  for (const value of ticks(...ys, logY)) {
    element("path", { class: "grid", d: `M${left} ${y(value)}H${wide - right}` }, svg);
    element("text", { x: left - 6, y: y(value) + 4, "text-anchor": "end" }, svg, digits(value));
  }
  element("rect", { class: "frame", x: left, y: top, width: wide - left - right, height: high - top - bottom }, svg);
  const clip = `clip-${svg.dataset.id}`;
  element("rect", { x: left, y: top, width: wide - left - right, height: high - top - bottom }, element("clipPath", { id: clip }, svg));
  const inside = element("g", { "clip-path": `url(#${clip})` }, svg);
  return { x, y, xs, ys, inside, box: [left, top, wide - right, high - bottom] };
};
const line = (points, frame, name) => {
  let d = "", pen = "M", last = null;
  for (const [a, b] of points) {
    if (!Number.isFinite(b) || !Number.isFinite(a)) { pen = "M"; continue; }
    const px = frame.x(a), py = Math.max(-1e4, Math.min(1e4, frame.y(b)));
    if (!Number.isFinite(py)) { pen = "M"; continue; }
    if (pen === "L" && last && Math.hypot(px - last[0], py - last[1]) < 0.4) continue;
    d += `${pen}${px.toFixed(2)} ${py.toFixed(2)}`;
    pen = "L";
    last = [px, py];
  }
  return element("path", { class: name, d }, frame.inside);
};
const around = (values, log) => {
  const finite = values.filter((value) => Number.isFinite(value) && (!log || value > 0)).sort((a, b) => a - b);
  if (!finite.length) return log ? [0.1, 1] : [0, 1];
  let low = finite[0], high = finite[finite.length - 1];
  const usual = finite[Math.floor(finite.length * 0.9)];
  if (log) return [Math.max(low / 1.5, high * 1e-9), high * 1.5];
  if (high > 8 * usual && usual > 0) high = 4 * usual; // what escapes to infinity does not flatten the rest
  if (low > 0 && low < high / 2) low = 0;
  const more = (high - low || Math.abs(high) || 1) * 0.06;
  return [low === 0 ? 0 : low - more, high + more];
};

const drawPlot = (picture, svg, s, slider) => {
  const [low, high] = picture.range(s);
  if (!(high > low)) return svg.replaceChildren();
  const log = slider?.log ?? false, many = 400, found = [];
  for (let n = 0; n <= many; n++) {
    const v = log ? low * (high / low) ** (n / many) : low + (high - low) * n / many;
    found.push([v, picture.at(s, v)]);
  }
  const curves = [];
  for (let c = 0; c < picture.count; c++) {
    const points = [];
    let going = true;
    for (const [v, values] of found) {
      going = picture.own >= 0 ? values[2 * c + 1] === 1 : going && values[2 * c + 1] === 1;
      points.push([v, going ? values[2 * c] : NaN]);
    }
    curves.push(points);
  }
  const frame = axes(svg, [low, high], around(curves.flat().map((point) => point[1]), picture.log), { logX: log, logY: picture.log });
  curves.forEach((points, c) => line(points, frame, `curve n${c}`));
  if (picture.own < 0) return;
  const now = s[picture.own], values = picture.at(s, now);
  element("path", { class: "now", d: `M${frame.x(now)} ${frame.box[1]}V${frame.box[3]}` }, frame.inside);
  for (let c = 0; c < picture.count; c++) {
    if (values[2 * c + 1] === 1 && Number.isFinite(values[2 * c])) element("circle", { class: `dot n${c}`, r: 4.5, cx: frame.x(now), cy: frame.y(values[2 * c]) }, frame.inside);
  }
};

// The instants along y at which a condition changes, for one x: found on a grid and then by halving.
const changes = (picture, s, x, Y) => {
  const at = (place) => { const moved = [...s]; moved[picture.x] = x; moved[picture.y] = valueExactly(Y, place); return picture.at(moved)[0] === 1; };
  const found = [], many = 64;
  let before = at(0);
  if (before) found.push(0);
  for (let n = 1; n <= many; n++) {
    const here = at(n / many);
    if (here !== before) {
      let a = (n - 1) / many, b = n / many;
      for (let turn = 0; turn < 30; turn++) { const middle = (a + b) / 2; if (at(middle) === before) a = middle; else b = middle; }
      found.push((a + b) / 2);
      before = here;
    }
  }
  if (before) found.push(1);
  return found.map((place) => valueExactly(Y, place));
};
const valueExactly = (slider, share) => slider.log
  ? slider.lowest * (slider.highest / slider.lowest) ** share : slider.lowest + (slider.highest - slider.lowest) * share;
const drawRegion = (picture, svg, s, sliders) => {
  const X = sliders[picture.x], Y = sliders[picture.y], many = 160;
  const frame = axes(svg, [X.lowest, X.highest], [Y.lowest, Y.highest], { logX: X.log, logY: Y.log });
  let d = "";
  const edge = [];
  const columns = [];
  for (let n = 0; n <= many; n++) { const x = valueExactly(X, n / many); columns.push([x, changes(picture, s, x, Y)]); }
  for (let n = 0; n < many; n++) {
    const [x1, first] = columns[n], [x2, second] = columns[n + 1];
    const other = second.length === first.length ? second : first;
    for (let i = 0; i + 1 < first.length; i += 2) {
      d += `M${frame.x(x1)} ${frame.y(first[i])}L${frame.x(x2) + 0.3} ${frame.y(other[i])}V${frame.y(other[i + 1])}L${frame.x(x1)} ${frame.y(first[i + 1])}Z`;
    }
    if (other === second) for (let i = 0; i < first.length; i++) {
      const inner = (value) => value > Y.lowest && value < Y.highest;
      if (inner(first[i]) || inner(second[i])) edge.push([x1, first[i]], [x2, second[i]], [NaN, NaN]);
    }
  }
  element("path", { class: "feasible", d }, frame.inside);
  line(edge, frame, "curve n0");
  const holds = picture.at(s)[0] === 1;
  element("circle", { class: `here ${holds ? "in" : "out"}`, r: 6, cx: frame.x(s[picture.x]), cy: frame.y(s[picture.y]) }, frame.inside);
  return holds;
};

// Level lines of the field, by the corners of small squares.
const levels = (picture, s, frame) => {
  const many = 56, [x1, x2] = frame.xs, [y1, y2] = frame.ys, grid = [];
  for (let i = 0; i <= many; i++) grid.push(Array.from({ length: many + 1 }, (_, j) => picture.field([x1 + (x2 - x1) * i / many, y1 + (y2 - y1) * j / many], s)[0]));
  const top = Math.max(...grid.flat()), bottom = Math.min(...grid.flat());
  let d = "";
  for (let n = 1; n < 9; n++) {
    const level = top - (top - bottom) * (n / 9) ** 2;
    for (let i = 0; i < many; i++) for (let j = 0; j < many; j++) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], cut = [];
      for (let k = 0; k < 4; k++) {
        const [a, b] = corners[k], [c, e] = corners[(k + 1) % 4], one = grid[a][b] - level, other = grid[c][e] - level;
        if ((one > 0) !== (other > 0)) { const w = one / (one - other); cut.push([a + w * (c - a), b + w * (e - b)]); }
      }
      for (let k = 0; k + 1 < cut.length; k += 2) {
        d += [cut[k], cut[k + 1]].map(([a, b], place) => `${place ? "L" : "M"}${frame.x(x1 + (x2 - x1) * a / many).toFixed(1)} ${frame.y(y1 + (y2 - y1) * b / many).toFixed(1)}`).join("");
      }
    }
  }
  element("path", { class: "level", d }, frame.inside);
};

// The vehicle and what runs beside it: both are integrated a slice at a time, and drawn when they are there.
const vehicleOf = (picture, box, changed) => {
  const plane = box.querySelector(".plane svg"), far = box.querySelector(".far svg"), said = box.querySelector(".said");
  const play = box.querySelector(".play"), time = box.querySelector(".time"), now = box.querySelector(".now-at");
  let turn = 0, runs = null, s = null, frames = null, source = [0, 0], end = 1, from = 0, playing = false;
  const distance = (point) => Math.hypot(point[1] - source[0], point[2] - source[1]);
  const shownTime = (point) => picture.clock(point[0], s)[0];
  const at = (path, t) => { // the last point of a path before an instant of the shown time
    let a = 0, b = path.length - 1;
    while (a < b) { const middle = (a + b + 1) >> 1; if (shownTime(path[middle]) <= t) a = middle; else b = middle - 1; }
    return path[a];
  };
  const mark = () => {
    if (!frames || !runs) return;
    const t = from + (end - from) * time.value / 1000;
    box.querySelectorAll(".marker").forEach((old) => old.remove());
    runs.forEach(({ path }, n) => {
      const point = at(path, t);
      element("circle", { class: `marker n${n}`, r: 5, cx: frames[0].x(point[1]), cy: frames[0].y(point[2]) }, frames[0].inside);
      element("circle", { class: `marker n${n}`, r: 4, cx: frames[1].x(shownTime(point)), cy: frames[1].y(distance(point)) }, frames[1].inside);
    });
    now.textContent = `t = ${digits(t)} s`;
  };
  const draw = () => {
    if (!runs) return;
    const all = runs.flatMap(({ path }) => path.filter((_, n) => n % 4 === 0 || n === path.length - 1)).concat([[0, ...source]]);
    const range = (i) => { const values = all.map((point) => point[i]).filter(Number.isFinite), more = 0.4; return [Math.min(...slices(values, Math.min)) - more, Math.max(...slices(values, Math.max)) + more]; };
    frames = [axes(plane, range(1), range(2), { even: true, height: Math.min(380, Math.max(260, (plane.parentElement.clientWidth || 400) * 0.8)) })];
    levels(picture, s, frames[0]);
    const paths = runs.map(({ path }) => path.map((point) => [shownTime(point), distance(point)]));
    frames.push(axes(far, [from, end], [0, Math.max(...slices(paths.flat().map((point) => point[1]).filter(Number.isFinite), Math.max), 0.1) * 1.06]));
    runs.forEach(({ path }, n) => { line(path.map((point) => [point[1], point[2]]), frames[0], `curve n${n}`); line(paths[n], frames[1], `curve n${n}`); });
    const [a, b] = [frames[0].x(source[0]), frames[0].y(source[1])];
    element("path", { class: "source", d: `M${a - 6} ${b}H${a + 6}M${a} ${b - 6}V${b + 6}` }, frames[0].inside);
    mark();
  };
  const tell = () => {
    said.replaceChildren(...runs.map((one, n) => {
      const row = document.createElement("p"), last = one.path[one.path.length - 1];
      row.className = `end n${n}`;
      row.textContent = `${box.dataset.names.split("|")[n]}: ${one.failed || `at t = ${digits(shownTime(last))} s`}, at (${digits(last[1])}, ${digits(last[2])}), ${digits(distance(last))} m from the source`;
      return row;
    }));
  };
  const start = (values) => {
    s = values;
    const mine = ++turn, edges = picture.edges(s);
    source = picture.source(s);
    const both = [march(picture.system, s, edges), march(picture.beside, s, edges)];
    box.setAttribute("aria-busy", "true");
    const go = () => {
      if (mine !== turn) return;
      for (let n = 0, more = true; n < STEPS_AT_ONCE && more; n++) more = both.map((one) => one.step()).some(Boolean);
      if (both.some((one) => one.t < edges[edges.length - 1] && !one.failed)) return void setTimeout(go);
      runs = both.map(({ path, failed }, n) => ({ failed, path: path.map(([t, ...x]) => [t, ...picture[n ? "beside" : "system"].place(t, x, s)]) }));
      from = picture.clock(edges[0], s)[0];
      end = picture.clock(edges[edges.length - 1], s)[0];
      draw();
      tell();
      box.removeAttribute("aria-busy");
      changed?.();
    };
    go();
  };
  const stop = () => { playing = false; play.textContent = "▶ Run"; };
  play.addEventListener("click", () => {
    if (playing) return stop();
    playing = true;
    play.textContent = "❚❚ Pause";
    if (Number(time.value) >= 1000) time.value = 0;
    let last = null;
    const slow = matchMedia("(prefers-reduced-motion: reduce)").matches; // then in a few jumps
    const tick = (instant) => {
      if (!playing) return;
      last ??= instant;
      if (!slow || instant - last > 1000) { time.value = Math.min(1000, Number(time.value) + (instant - last) / 8); last = instant; mark(); }
      if (Number(time.value) >= 1000) return stop();
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  });
  time.addEventListener("input", () => { stop(); mark(); });
  return { start, draw };
};
const slices = (values, of) => { const found = []; for (let n = 0; n < values.length; n += 5000) found.push(of(...values.slice(n, n + 5000))); return found.length ? found : [0]; };

// --- The page ---
const set = (tool, section) => {
  const inputs = tool.sliders.map((slider) => ["range", "number"].map((type) => section.querySelector(`input[type=${type}][name="${slider.name}"]`)));
  const rows = [...section.querySelectorAll(".row")], command = section.querySelector(".command code");
  const boxes = [...section.querySelectorAll(".picture-box")];
  let s = tool.sliders.map((slider) => slider.start);
  const vehicles = tool.pictures.map((picture, n) => picture.kind === "vehicle" ? vehicleOf(picture, boxes[n]) : null);
  const draw = () => tool.pictures.forEach((picture, n) => {
    const svg = boxes[n].querySelector("svg");
    if (picture.kind === "plot") drawPlot(picture, svg, s, picture.own < 0 ? null : tool.sliders[picture.own]);
    else if (picture.kind === "region") {
      const holds = drawRegion(picture, svg, s, tool.sliders), said = boxes[n].querySelector(".said");
      const inside = "proved" in boxes[n].dataset ? "it is proved here" : "all that is assumed holds here, but the claim is not proved";
      said.textContent = holds ? `The sliders stand inside: ${inside}.` : "The sliders stand outside: nothing is proved here.";
      said.className = `said ${holds ? "yes" : "no"}`;
    } else vehicles[n].draw();
  });
  const tell = () => {
    const values = tool.values(s);
    tool.rows.forEach((row, n) => {
      const value = values[row.at], output = rows[n].querySelector("output"), sides = values.slice(row.at + 1, row.at + 1 + row.sides);
      output.textContent = row.holds ? (value === 1 ? "holds" : value === 0 ? "does not hold" : "not defined") : digits(value);
      output.className = row.holds ? (value === 1 ? "yes" : "no") : "";
      const beside = rows[n].querySelector(".sides");
      if (beside) beside.textContent = sides.map(digits).join(" against ");
      const needs = values.slice(row.at + 1 + row.sides, row.at + 1 + row.sides + row.needs);
      rows[n].querySelectorAll(".need").forEach((need, place) => need.classList.toggle("unmet", needs[place] !== 1));
      rows[n].classList.toggle("outside", needs.some((need) => need !== 1));
    });
    if (command) command.textContent = tool.sliders.reduce((text, slider, n) => text.replaceAll(`{${slider.name}}`, String(s[n])), tool.command);
  };
  let asked = 0;
  const move = (values, keep = true) => {
    s = values;
    tool.sliders.forEach((slider, n) => {
      const [range, number] = inputs[n];
      range.value = placeOf(slider, s[n]);
      range.setAttribute("aria-valuetext", `${s[n]} ${range.dataset.unit}`.trim());
      if (document.activeElement !== number || Number(number.value) !== s[n]) number.value = s[n];
    });
    tell();
    if (keep) history.replaceState(null, "", stateOf());
    clearTimeout(asked); // not in a frame: a page that is printed, or not looked at, has none
    asked = setTimeout(() => {
      draw();
      vehicles.forEach((vehicle) => vehicle?.start(s));
    });
  };
  const stateOf = () => `#${section.id}:` + tool.sliders.map((slider, n) => s[n] === slider.start ? "" : `${slider.name}=${s[n]}`).filter(Boolean).join(",");
  inputs.forEach(([range, number], n) => {
    const put = (value) => {
      const slider = tool.sliders[n];
      if (!Number.isFinite(value)) return;
      const kept = Math.min(slider.highest, Math.max(slider.lowest, value));
      move(s.map((old, place) => place === n ? (slider.integer ? Math.round(kept) : kept) : old));
    };
    range.addEventListener("input", () => put(valueAt(tool.sliders[n], Number(range.value))));
    number.addEventListener("change", () => put(Number(number.value)));
  });
  const first = tool.sliders.map((slider) => slider.start);
  section.querySelector("form").addEventListener("reset", (event) => { event.preventDefault(); move(first); });
  section.querySelector("form").addEventListener("submit", (event) => event.preventDefault());
  section.querySelector(".copy")?.addEventListener("click", async (event) => {
    const button = event.currentTarget;
    try { await navigator.clipboard.writeText(command.textContent); button.textContent = "Copied"; }
    catch { getSelection().selectAllChildren(command); button.textContent = "Selected"; }
    setTimeout(() => { button.textContent = "Copy"; }, 1500);
  });
  const restore = () => {
    const [id, said] = decodeURIComponent(location.hash.slice(1)).split(":");
    if (id !== section.id || said === undefined) return false;
    const given = new Map(said.split(",").map((pair) => pair.split("=")));
    move(tool.sliders.map((slider) => {
      const value = Number(given.get(slider.name) ?? NaN);
      return value >= slider.lowest && value <= slider.highest ? value : slider.start;
    }), false);
    section.scrollIntoView();
    return true;
  };
  let kept = s;
  addEventListener("beforeprint", () => { kept = s; if (s.some((value, n) => value !== first[n])) move(first, false); draw(); });
  addEventListener("afterprint", () => { if (kept.some((value, n) => value !== s[n])) move(kept, false); });
  addEventListener("hashchange", restore);
  if (!restore()) move(first, false);
  let width = section.clientWidth;
  const resized = () => { if (section.clientWidth !== width) { width = section.clientWidth; draw(); } };
  new ResizeObserver(() => setTimeout(resized)).observe(section);
  return { get values() { return s; }, move };
};
window.PTPROOF_INSTRUMENTS = { tools: INSTRUMENTS, run, changes, valueExactly, digits };
for (const tool of INSTRUMENTS) {
  const section = document.getElementById(`i-${tool.name}`);
  if (section) set(tool, section);
}
