"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const made = (tag, properties) => Object.assign(document.createElement(tag), properties);
const largestOf = (values) => values.reduce((a, b) => Math.max(a, b), 0);

// --- The solvers: the project's compiled kernels, as WebAssembly --------------------------------

const STACK = 1 << 20; // the constants of a module and its stack lie below, arrays above
const [FREE, MIRROR] = [1, 3];
const ENDS = { dirichlet: 0, free: FREE, periodic: FREE }; // an even solution on a ring sees itself
const PARTS = ["a_re", "a_im", "b_re", "b_im"];
const decoded = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

// Return a solver as a function of settings, the step of its outputs, and how many of them go to a
// snapshot of the moduli. A run without snapshots has no energy either.
const load = async (name, { code, controls, work }) => {
  const memory = new WebAssembly.Memory({ initial: 1024 });
  const env = {
    __linear_memory: memory,
    __stack_pointer: new WebAssembly.Global({ value: "i32", mutable: true }, STACK),
    // numba asks for the strides of an array that it sees in another shape: all are contiguous
    numba_attempt_nocopy_reshape: (rank, shape, strides, newRank, newShape, newStrides) => {
      const view = new DataView(memory.buffer);
      for (let axis = Number(newRank) - 1, stride = 8n; axis >= 0; axis -= 1) {
        view.setBigInt64(newStrides + 8 * axis, stride, true);
        stride *= view.getBigInt64(newShape + 8 * axis, true);
      }
      return 1;
    },
    // the number next to a positive one
    numba_nextafter: (x, towards) => {
      const bits = new BigInt64Array(new Float64Array([x]).buffer);
      bits[0] += towards > x ? 1n : -1n;
      return new Float64Array(bits.buffer)[0];
    },
  };
  const { instance } = await WebAssembly.instantiate(decoded(code), { env });
  let free = STACK;
  // zeros of a shape: the numbers, and what numba passes to a kernel for such an array
  const array = (...shape) => {
    const count = shape.reduce((a, b) => a * b, 1);
    const strides = shape.map((_, axis) => shape.slice(axis + 1).reduce((a, b) => a * b, 8));
    const [place, numbers] = [free, shape.concat(strides).map(BigInt)];
    free += (8 * count + 63) & ~63;
    const values = new Float64Array(memory.buffer, place, count).fill(0);
    return { values, place, passed: [0, 0, BigInt(count), 8n, place, ...numbers] };
  };
  const solve = (given, outputStep, every) => {
    // half of the chain, since the data are even, and A alone where A = B
    const start = PARTS.map((part) => given[part]);
    const components = start[0] === start[2] && start[1] === start[3] ? 1 : 2;
    const outputs = Math.round(given.end_time / outputStep);
    const [sites, rows] = [given.half_width + 1, 2 * components];
    const [width, snapshots] = [sites + 2, every ? Math.floor(outputs / every) + 1 : 0];
    free = STACK;
    const [outcome, fault, y, times] = [array(5), array(1), array(rows, width), array(outputs + 1)];
    start.slice(0, rows).forEach((value, row) => { y.values[row * width + 1] = value; });
    times.values.forEach((_, i) => { times.values[i] = (given.end_time * i) / outputs; });
    const [linf, l2] = [array(components, outputs + 1), array(components, outputs + 1)];
    const energy = array(every ? outputs + 1 : 0);
    const modulus = array(components, sites, snapshots);
    const error = instance.exports.run(
      outcome.place, fault.place,
      ...[given.epsilon, given.gamma, given.omega, BigInt(MIRROR), BigInt(ENDS[given.boundary])],
      ...[...y.passed, ...times.passed, ...controls, ...array(work, rows, width).passed],
      ...[...linf.passed, ...l2.passed, ...energy.passed, ...modulus.passed, BigInt(every)],
      ...[...array(2, width).passed, ...array(1).passed],
    );
    const [status] = new BigInt64Array(memory.buffer, outcome.place, 1);
    if (error || status) {
      throw new Error(`${name} stopped at τ = ${outcome.values[1]}: ${data.faults[status] ?? "an error"}`);
    }
    const both = ({ values }) => {
      const part = values.length / components;
      return [values.slice(0, part), values.slice(values.length - part)];
    };
    const kept = { linf: both(linf), l2: both(l2), modulus: both(modulus), state: both(y) };
    return { ...kept, tau: times.values.slice(), energy: energy.values.slice(), sites, snapshots, every };
  };
  return [name, Object.assign(solve, { controls })];
};

// --- The same bits? -----------------------------------------------------------------------------

// A hash for each output time, over the words of its norms, its energy and its moduli.
const marksOf = ({ tau, linf, l2, energy, modulus, sites, snapshots, every }) => {
  const marks = new Uint32Array(tau.length).fill(data.hash.offset);
  const take = (i, word) => { marks[i] = Math.imul(marks[i] ^ word, data.hash.prime); };
  for (const values of [...linf, ...l2, energy]) {
    new Uint32Array(values.buffer).forEach((word, k) => take(k >> 1, word));
  }
  for (const half of modulus) {
    const words = new Uint32Array(Float32Array.from(half).buffer);
    for (let n = 1 - sites; n < sites; n += 1) {
      for (let s = 0; s < snapshots; s += 1) take(s * every, words[Math.abs(n) * snapshots + s]);
    }
  }
  return marks;
};

const compareCase = (one) => Object.entries(one.marks).map(([solver, text]) => {
  const run = solvers[solver](one.settings, one.output_step, one.every);
  const [marks, accepted] = [marksOf(run), new Uint32Array(decoded(text).buffer)];
  const first = accepted.findIndex((mark, i) => mark !== marks[i]);
  const told = first < 0 ? `the same at all ${accepted.length} times` : `first differs at τ = ${run.tau[first]}`;
  return { same: first < 0, told: `${solver} ${told}` };
});
const compareAll = () => {
  const found = data.cases.map(compareCase);
  const lines = found.map((solved, i) => {
    const same = solved.every((one) => one.same);
    const [sign, told] = [same ? "✓" : "✗", solved.map((one) => one.told).join(", ")];
    return made("li", { className: same ? "same" : "other", textContent: `${sign} ${data.cases[i].title}: ${told}` });
  });
  byId("bits").replaceChildren(...lines);
  const agree = lines.filter(({ className }) => className === "same").length;
  byId("same-bits").textContent = `${agree} of ${data.cases.length}`;
};

// --- Settings -----------------------------------------------------------------------------------

const OUTPUT_STEP = 0.025;
const EVERY = 4;
const SLIDERS = [
  ["omega", "Ω, detuning", -12, 12, 0.1],
  ["gamma", "γ, strength of the drive", 0, 3, 0.05],
  ["epsilon", "ε, coupling", 0, 3, 0.05],
  ["half_width", "M, half-width of the chain", 1, 100, 1],
  ["a_re", "Re A₀", -10, 10, 0.1],
  ["a_im", "Im A₀", -10, 10, 0.1],
  ["b_re", "Re B₀", -10, 10, 0.1],
  ["b_im", "Im B₀", -10, 10, 0.1],
  ["end_time", "End of the run, τ", 1, 100, 1],
];
const CHOICES = ["boundary", "solver"];
let settings = null;
let solvers = null;
const chosen = () => data.cases[byId("case").selectedIndex];
const isOfPaper = () => {
  const own = Object.entries(chosen().settings).filter(([key]) => key !== "solver");
  return own.every(([key, value]) => settings[key] === value);
};

// Take settings, and let all controls say what they are.
const apply = (given) => {
  settings = given;
  for (const key of [...SLIDERS.map(([name]) => name), ...CHOICES]) byId(key).value = settings[key];
  for (const [key] of SLIDERS) byId(`${key}_said`).textContent = settings[key];
  byId("link").href = `#${new URLSearchParams(settings)}`;
  const [slider, atEnd] = [byId("tau"), byId("tau").value === byId("tau").max];
  slider.max = settings.end_time;
  if (atEnd) slider.value = slider.max;
  update();
};
// The controls refuse what a link says and they cannot.
const fromLink = () => {
  const read = { ...chosen().settings };
  for (const [key, text] of new URLSearchParams(location.hash.slice(1))) {
    if (key in read) {
      byId(key).value = text;
      if (byId(key).value) read[key] = CHOICES.includes(key) ? byId(key).value : Number(byId(key).value);
    }
  }
  apply(read);
};
const makeSlider = ([id, text, min, max, step]) => {
  const label = made("label", { htmlFor: id, textContent: `${text} = ` });
  const range = made("input", { type: "range", id, min, max, step });
  label.append(made("output", { id: `${id}_said`, htmlFor: id }));
  range.addEventListener("input", () => apply({ ...settings, [id]: Number(range.value) }));
  byId("sliders").append(label, range);
};

// --- Pictures -----------------------------------------------------------------------------------

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
const penOf = (canvas) => {
  const [scale, { clientWidth: width, clientHeight: height }] = [window.devicePixelRatio, canvas];
  Object.assign(canvas, { width: width * scale, height: height * scale });
  const pen = canvas.getContext("2d");
  pen.scale(scale, scale);
  pen.font = "13px system-ui, sans-serif";
  return { pen, width, height };
};
const ticks = (least, most, count) => {
  const unit = 10 ** Math.floor(Math.log10((most - least) / count));
  const step = unit * [1, 2, 5, 10].find((times) => times * unit * count >= most - least);
  const first = Math.ceil(least / step);
  const length = Math.floor(most / step + 1e-9) - first + 1;
  return Array.from({ length }, (_, i) => Number(((first + i) * step).toPrecision(6)));
};
// Draw axes; `x` and `y` return where a time and a value between `least` and `most` come to lie.
const axes = (canvas, least, most, title) => {
  const { pen, width, height } = penOf(canvas);
  const [left, top, right, bottom] = [40, 24, width - 12, height - 22];
  const x = (tau) => left + ((right - left) * tau) / settings.end_time;
  const y = (value) => bottom - ((bottom - top) * (value - least)) / (most - least);
  pen.fillStyle = colour("ink");
  pen.strokeStyle = colour("rule");
  pen.textAlign = "right";
  for (const value of ticks(least, most, height / 40)) {
    pen.fillText(value, left - 6, y(value) + 4);
    pen.strokeRect(left, y(value), right - left, 0);
  }
  pen.fillText("τ", right + 10, bottom + 16);
  pen.textAlign = "center";
  const times = ticks(0, settings.end_time, width / 70);
  times.filter((tau) => x(tau) < right - 14).forEach((tau) => pen.fillText(tau, x(tau), bottom + 16));
  pen.textAlign = "left";
  pen.fillText(title, left, 15);
  return { pen, x, y, left, top, right, bottom };
};
const line = (pen, name, points, dash = []) => {
  pen.strokeStyle = colour(name);
  pen.setLineDash(dash);
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x, y);
  pen.stroke();
  pen.setLineDash([]);
};
const upright = ({ pen, x, top, bottom }, tau, name, dash) => line(pen, name, [[x(tau), top], [x(tau), bottom]], dash);

let run = null;
let other = null;
let parted = null;
let images = null;
let life = null;
const now = () => Number(byId("tau").value);
const horizon = () => (isOfPaper() ? chosen().horizon[settings.solver] : null);

const drawNorm = (norm, title) => {
  const curves = [...run[norm], ...(other ? other[norm] : [])];
  const plot = axes(byId(norm), 0, 1.03 * Math.max(...curves.map(largestOf), 1e-9), title);
  curves.forEach((values, i) => {
    plot.pen.lineWidth = i < 2 ? 1.8 : 1.2;
    const points = Array.from(values, (value, k) => [plot.x(run.tau[k]), plot.y(value)]);
    line(plot.pen, i % 2 ? "b" : "a", points, i < 2 ? [] : [5, 4]);
  });
  if ((horizon() ?? Infinity) < settings.end_time) upright(plot, horizon(), "ink", [4, 4]);
  if (parted) upright(plot, parted, "over", [2, 3]);
  upright(plot, now(), "link", []);
};
// A picture of the moduli on one half of the chain: the larger one is, the less paper shows through.
const imageOf = (half, name, largest) => {
  const image = new ImageData(run.snapshots, 2 * run.sites - 1);
  const pixels = new Uint32Array(image.data.buffer);
  const [, red, green, blue] = colour(name).match(/#(..)(..)(..)/);
  for (let row = 0; row < image.height; row += 1) {
    const start = Math.abs(run.sites - 1 - row) * run.snapshots;
    for (let s = 0; s < run.snapshots; s += 1) {
      const opacity = Math.round((255 * half[start + s]) / largest);
      pixels[row * run.snapshots + s] = (opacity << 24) | `0x${blue}${green}${red}`;
    }
  }
  const canvas = made("canvas", { width: image.width, height: image.height });
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
};
const drawAll = () => {
  drawNorm("l2", "ℓ² norms");
  drawNorm("linf", "ℓ∞ norms");
  const edge = run.sites - 0.5;
  images.pictures.forEach((picture, component) => {
    const name = "AB"[component];
    const plot = axes(byId(`modulus${name}`), -edge, edge, `|${name}ₙ| at pair n, 0 to ${say(images.largest)}`);
    plot.pen.imageSmoothingEnabled = false;
    plot.pen.drawImage(picture, plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
    upright(plot, now(), "link", []);
  });
};

// Two rows of pendula: x = 2μ Re(A e^{iφ}) above, y below, and φ is the phase of the swing.
let state = null;
let phase = 0;
const drawPendula = () => {
  const { pen, width, height } = penOf(byId("pendula"));
  const [mu, pairs] = [Number(byId("mu").value), 2 * settings.half_width + 1];
  const length = 0.22 * height;
  const slot = (width - 2 * length) / (pairs + 1); // the outer ones need room to swing
  let over = 0;
  state.forEach((rows, component) => {
    const hook = (0.25 + 0.5 * component) * height;
    for (let place = 0; place < pairs; place += 1) {
      const at = Math.abs(place - settings.half_width) + 1;
      const [re, im] = [rows[at], rows[rows.length / 2 + at]];
      const angle = 2 * mu * (re * Math.cos(phase) - im * Math.sin(phase));
      const isOver = 2 * mu * Math.hypot(re, im) > Math.PI;
      const from = length + (place + 1) * slot;
      const [x, y] = [from + length * Math.sin(angle), hook + length * Math.cos(angle)];
      over += isOver;
      line(pen, isOver ? "over" : "ab"[component], [[from, hook], [x, y]]);
      pen.fillStyle = pen.strokeStyle;
      pen.beginPath();
      if (isOver) pen.rect(x - 5, y - 5, 10, 10);
      else pen.arc(x, y, Math.max(2, Math.min(6, 0.45 * slot)), 0, 2 * Math.PI);
      pen.fill();
    }
  });
  byId("swings").textContent = `μ = ${mu}: a pendulum swings about ${say(1 / (Math.PI * mu * mu))} times in a unit of τ, `
    + `and once a second here. Over the top at this τ: ${over} of ${2 * pairs}.`;
};

// --- Words --------------------------------------------------------------------------------------

const say = (number) => {
  const small = number && Math.abs(number) < 1e-3;
  return (small ? number.toExponential(2) : String(Number(number.toPrecision(4)))).replaceAll("-", "−");
};
// Return the first time at which the central pair holds no more than an even share of the power.
const lifeOf = ({ modulus, sites, snapshots, tau, every }) => {
  const power = (n, s) => modulus[0][n * snapshots + s] ** 2 + modulus[1][n * snapshots + s] ** 2;
  for (let s = 0; s < snapshots; s += 1) {
    let others = 0;
    for (let n = 1; n < sites; n += 1) others += power(n, s); // each stands for n and -n
    if (power(0, s) * (sites - 1) <= others) return tau[s * every];
  }
  return null;
};
const tell = () => {
  const i = Math.round(now() / OUTPUT_STEP);
  const norms = ["l2", "linf"].map((norm) => `${say(run[norm][0][i])} of A and ${say(run[norm][1][i])} of B`);
  const until = life === null ? "to the end: the motion stays localised" : `until τ = ${say(life)}`;
  byId("numbers").textContent = `At τ = ${say(now())}: ℓ² norms ${norms[0]}, largest amplitudes ${norms[1]}. `
    + `The central pair holds more than an even share of the power Σ|Aₙ|² + |Bₙ|² ${until}. `
    + `The energy has changed by ${say(run.energy[i] - run.energy[0])} since τ = 0.`;
  byId("tau_said").textContent = `τ = ${say(now())}`;
  byId("l2").setAttribute("aria-label", `ℓ² norms against time: ${norms[0]}`);
  byId("linf").setAttribute("aria-label", `ℓ∞ norms against time: ${norms[1]}`);
};
const tellHorizon = () => {
  const { title, contained, horizon: times, settings: own } = chosen();
  if (!isOfPaper()) return "These settings are your own, and nothing is certified of them.";
  const before = (time) => (time < own.end_time ? `until τ = ${say(time)}` : "to the end");
  const until = (time) => (time === null ? "at no known time" : before(time));
  return `Certified horizon of ${title}: the printed line, by ode45, is proved to contain the true curve ${until(contained)}. `
    + `The run by ${settings.solver} is within ${100 * data.visible} % of the true norms ${until(times[settings.solver])}, as the reference in `
    + `multiprecision tells (a dashed line where this is not the end).`;
};
// Return the first time at which the norms of two runs differ by the visible part of full scale.
const partingOf = (one, two) => {
  const pairs = ["linf", "l2"].flatMap((norm) => [0, 1].map((k) => [one[norm][k], two[norm][k]]));
  const limits = pairs.map((pair) => data.visible * (Math.max(...pair.map(largestOf)) || 1));
  return one.tau.find((_, i) => pairs.some(([p, q], k) => Math.abs(p[i] - q[i]) > limits[k]));
};
const isPerturbed = () => byId("perturb").getAttribute("aria-pressed") === "true";
const sizeOf = () => 10 ** Number(byId("size").value);
const perturb = () => {
  const changed = { ...settings };
  const size = sizeOf();
  for (const part of PARTS) changed[part] *= 1 + size;
  other = solvers[settings.solver](changed, OUTPUT_STEP, 0);
  parted = partingOf(run, other);
  const when = parted ? `at τ = ${say(parted)} (the dotted line)` : "at no time";
  return `With data larger by the factor 1 + ${size.toExponential(0)} (dashed curves) the norms part by `
    + `${100 * data.visible} % of full scale ${when}.`;
};

// --- What a change of the settings, or of the time, asks for ------------------------------------

const updateTime = () => {
  tell();
  drawAll();
  const [tau, end] = [Math.max(now(), 1e-6), settings.end_time]; // a run has a length
  state = tau < end ? solvers[settings.solver]({ ...settings, end_time: tau }, tau, 0).state : run.state;
  drawPendula();
};
let asked = false;
const update = () => {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    const start = performance.now();
    try {
      [run, other, parted] = [solvers[settings.solver](settings, OUTPUT_STEP, EVERY), null, null];
      const largest = Math.max(...run.modulus.map(largestOf), 1e-300);
      images = { largest, pictures: run.modulus.map((half, k) => imageOf(half, "ab"[k], largest)) };
      life = lifeOf(run);
      byId("size_said").textContent = sizeOf().toExponential(0);
      byId("parted").textContent = `${isPerturbed() ? perturb() : ""} ${tellHorizon()}`;
      updateTime();
      byId("fault").textContent = "";
    } catch (fault) {
      byId("fault").textContent = fault.message;
    }
    asked = false;
    document.body.dataset.frame = performance.now() - start;
  });
};

// --- Play, export, and the start ----------------------------------------------------------------

const still = window.matchMedia("(prefers-reduced-motion: reduce)");
let last = null; // the time of the picture before, while it plays
const moveTo = (tau) => {
  byId("tau").value = tau;
  updateTime();
};
const setPlaying = (since) => {
  last = since;
  byId("play").textContent = since === null ? "Play" : "Pause";
  byId("numbers").ariaLive = since === null ? "polite" : "off";
  if (since !== null) requestAnimationFrame(play);
};
const play = (time) => {
  if (last === null) return;
  const passed = Math.max(0, Math.min((time - last) / 1000, 0.2));
  if (!still.matches) phase += 2 * Math.PI * passed;
  moveTo(now() + passed);
  setPlaying(now() < settings.end_time ? time : null);
};
const startOrStop = () => {
  if (last === null && now() === settings.end_time) moveTo(0);
  setPlaying(last === null ? performance.now() : null);
};

const save = (name, text) => {
  const address = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  made("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
};
const csv = () => {
  const columns = [run.tau, ...run.l2, ...run.linf, run.energy];
  const rows = Array.from(run.tau, (_, i) => columns.map((values) => values[i]));
  return ["tau,l2_A,l2_B,linf_A,linf_B,energy", ...rows, ""].join("\n");
};
// YAML takes 1e-7 for a word: a number with an exponent needs a point
const plain = (number) => String(number).replace(/^(-?\d+)e/, "$1.0e");
const complex = (re, im) => (im ? `"${plain(re)}${im < 0 ? "" : "+"}${plain(im)}j"` : plain(re));
const yaml = () => {
  const { a_re, a_im, b_re, b_im, solver, boundary, end_time } = settings;
  const constants = ["omega", "gamma", "epsilon"].map((key) => `${key}: ${plain(settings[key])}`);
  const [rtol, atol] = solvers[solver].controls.map(plain);
  return ["# .venv/bin/snakemake own --configfile mine.yaml", "cases:", "  mine:"].concat([
    ...constants,
    `half_width: ${settings.half_width}`,
    `boundary: ${boundary}`,
    `initial: {0: [${complex(a_re, a_im)}, ${complex(b_re, b_im)}]}`,
    `end_time: ${end_time}`,
    `output_step: ${OUTPUT_STEP}`,
    `snapshot_step: ${OUTPUT_STEP * EVERY}`,
    `solver: {name: ${solver}, rtol: ${rtol}, atol: ${atol}}`,
  ].map((line) => `    ${line}`), "").join("\n");
};

const listen = (id, event, act) => byId(id).addEventListener(event, act);
const begin = async () => {
  const loaded = Object.entries(data.solvers).map(([name, given]) => load(name, given));
  solvers = Object.fromEntries(await Promise.all(loaded));
  SLIDERS.forEach(makeSlider);
  data.cases.forEach(({ title }) => byId("case").add(new Option(title)));
  const reset = () => {
    setPlaying(null);
    byId("tau").value = byId("tau").max;
    apply({ ...chosen().settings });
  };
  listen("case", "change", reset);
  listen("reset", "click", reset);
  for (const key of CHOICES) listen(key, "change", () => apply({ ...settings, [key]: byId(key).value }));
  listen("tau", "input", () => moveTo(byId("tau").value));
  listen("play", "click", startOrStop);
  listen("mu", "input", drawPendula);
  listen("perturb", "click", () => {
    byId("perturb").setAttribute("aria-pressed", String(!isPerturbed()));
    update();
  });
  listen("size", "input", update);
  listen("compare", "click", compareAll);
  listen("csv", "click", () => save("mine.csv", csv()));
  listen("yaml", "click", () => save("mine.yaml", yaml()));
  window.addEventListener("resize", update);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", update);
  const byLink = () => (location.hash === "#same-bits" ? compareAll() : fromLink());
  window.addEventListener("hashchange", byLink);
  reset();
  if (location.hash) byLink();
};
begin().catch((fault) => {
  byId("fault").textContent = `This browser cannot run the solvers: ${fault.message}`;
});
