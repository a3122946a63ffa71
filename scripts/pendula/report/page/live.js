"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

// --- The solvers: the project's compiled kernels, as WebAssembly --------------------------------

const STACK = 1 << 20; // the constants of a module and its stack lie below, arrays above
const MIRROR = 3;
const ENDS = { dirichlet: 0, free: 1, periodic: 2 };
const decoded = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

class Solver {
  static async load(name, { code, controls, work }) {
    const memory = new WebAssembly.Memory({ initial: 1024 });
    const stack = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const env = {
      __linear_memory: memory,
      __stack_pointer: stack,
      // numba asks for the strides of an array that is seen in another shape: all are contiguous
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
    return Object.assign(new Solver(), { name, memory, controls, work, run: instance.exports.run });
  }

  // Return zeros of a shape: the numbers, and what numba passes to a kernel for such an array.
  array(...shape) {
    const count = shape.reduce((product, length) => product * length, 1);
    const place = this.free;
    this.free += (8 * count + 63) & ~63;
    const values = new Float64Array(this.memory.buffer, place, count).fill(0);
    const strides = shape.map((_, axis) => shape.slice(axis + 1).reduce((a, b) => a * b, 8));
    return { values, place, passed: [0, 0, BigInt(count), 8n, place, ...shape.concat(strides).map(BigInt)] };
  }

  // Integrate a problem of even data: the half of the chain, and A alone where A = B, as
  // pendula.simulation.lattice has it. Times, norms, energy, moduli, and the state at the end.
  solve({ omega, gamma, epsilon, half_width, boundary, a_re, a_im, b_re, b_im, end_time }, output_step, every) {
    this.free = STACK;
    const components = a_re === b_re && a_im === b_im ? 1 : 2;
    const [sites, outputs] = [half_width + 1, Math.round(end_time / output_step)];
    const width = sites + 2;
    const snapshots = every ? Math.floor(outputs / every) + 1 : 0;
    const [outcome, fault] = [this.array(5), this.array(1)];
    const y = this.array(2 * components, width);
    [a_re, a_im, b_re, b_im].slice(0, 2 * components).forEach((value, row) => { y.values[row * width + 1] = value; });
    const times = this.array(outputs + 1);
    times.values.forEach((_, i) => { times.values[i] = (end_time * i) / outputs; });
    const norms = () => this.array(components, outputs + 1);
    const [linf, l2, energy] = [norms(), norms(), this.array(every ? outputs + 1 : 0)];
    const modulus = this.array(components, sites, snapshots);
    const right = boundary === "periodic" ? ENDS.free : ENDS[boundary];
    const work = this.array(this.work, 2 * components, width);
    const error = this.run(
      outcome.place, fault.place, epsilon, gamma, omega, BigInt(MIRROR), BigInt(right),
      ...y.passed, ...times.passed, ...this.controls, ...work.passed,
      ...linf.passed, ...l2.passed, ...energy.passed, ...modulus.passed, BigInt(every),
      ...this.array(2, width).passed, ...this.array(1).passed,
    );
    const [status] = new BigInt64Array(this.memory.buffer, outcome.place, 1);
    if (error || status) throw new Error(`${this.name} stopped at τ = ${outcome.values[1]}: ${data.faults[status] ?? "an error"}`);
    const both = (values) => {
      const part = values.length / components;
      return [values.slice(0, part), values.slice(values.length - part)];
    };
    return {
      tau: times.values.slice(), linf: both(linf.values), l2: both(l2.values), energy: energy.values.slice(),
      modulus: both(modulus.values), snapshots, every, sites, state: both(y.values), width,
    };
  }
}

// --- The same bits? -----------------------------------------------------------------------------

// A hash for each output time, over the words of its norms, its energy and its moduli (FNV).
const marksOf = ({ tau, linf, l2, energy, modulus, sites, snapshots, every }) => {
  const marks = new Uint32Array(tau.length).fill(2166136261);
  const take = (words, i, first, count) => {
    for (let k = first; k < first + count; k += 1) marks[i] = Math.imul(marks[i] ^ words[k], 16777619);
  };
  for (const values of [...linf, ...l2, energy]) {
    const words = new Uint32Array(values.buffer);
    marks.forEach((_, i) => take(words, i, 2 * i, 2));
  }
  for (const half of modulus) {
    const words = new Uint32Array(Float32Array.from(half).buffer);
    for (let s = 0; s < snapshots; s += 1) {
      for (let n = 1 - sites; n < sites; n += 1) take(words, s * every, Math.abs(n) * snapshots + s, 1);
    }
  }
  return marks;
};

const compareCase = (one) => {
  const found = Object.entries(one.marks).map(([solver, text]) => {
    const marks = marksOf(solvers[solver].solve(one.settings, one.output_step, one.every));
    const accepted = new Uint32Array(decoded(text).buffer);
    const first = marks.findIndex((mark, i) => mark !== accepted[i]);
    const same = first < 0 && marks.length === accepted.length;
    const told = same
      ? `all ${marks.length} outputs of ${solver} have the accepted bits`
      : `${solver} first differs at τ = ${(one.settings.end_time * first) / (marks.length - 1)}`;
    return { same, told };
  });
  return { same: found.every(({ same }) => same), told: found.map(({ told }) => told).join("; ") };
};

const compareAll = async () => {
  byId("bits").replaceChildren();
  byId("same-bits").textContent = "comparing …";
  let agree = 0;
  for (const one of data.cases) {
    await new Promise((resume) => setTimeout(resume));
    const { same, told } = compareCase(one);
    agree += same;
    const line = document.createElement("li");
    line.className = same ? "same" : "other";
    line.textContent = `${same ? "✓" : "✗"} ${one.title}: ${told}`;
    byId("bits").append(line);
  }
  byId("same-bits").textContent = `${agree} of ${data.cases.length}`;
};

// --- Settings -----------------------------------------------------------------------------------

const STEP = { output: 0.025, every: 4 };
const SLIDERS = [
  ["omega", "Ω, detuning", -12, 12, 0.1], ["gamma", "γ, strength of the drive", 0, 3, 0.05],
  ["epsilon", "ε, coupling", 0, 3, 0.05], ["half_width", "M, half-width of the chain", 1, 100, 1],
  ["a_re", "Re A₀", -8, 8, 0.1], ["a_im", "Im A₀", -8, 8, 0.1],
  ["b_re", "Re B₀", -8, 8, 0.1], ["b_im", "Im B₀", -8, 8, 0.1], ["end_time", "End of the run, τ", 1, 100, 1],
];
const CHOICES = ["boundary", "solver"];
const KEYS = [...SLIDERS.map(([key]) => key), ...CHOICES];
let settings = null;
let solvers = null;

const chosen = () => data.cases[byId("case").selectedIndex];
const ofPaper = (one) => ({ ...one.settings, solver: "ode45" });
const isOf = (one) => KEYS.every((key) => key === "solver" || settings[key] === one.settings[key]);

for (const [key, label, least, most, step] of SLIDERS) {
  const row = document.createElement("div");
  const name = Object.assign(document.createElement("label"), { htmlFor: key, textContent: label });
  const range = Object.assign(document.createElement("input"), { type: "range", id: key, min: least, max: most, step });
  const exact = Object.assign(document.createElement("input"), { type: "number", min: least, max: most, step: key === "half_width" || key === "end_time" ? 1 : "any" });
  exact.setAttribute("aria-label", `${label}, as a number`);
  for (const input of [range, exact]) {
    input.addEventListener("input", () => {
      const value = Number(input.value);
      if (input.value !== "" && value >= least && value <= most && input.validity.valid) apply({ ...settings, [key]: value });
    });
    input.addEventListener("change", () => show());
  }
  row.append(name, range, exact);
  byId("sliders").append(row);
}

// Let all controls say what the settings are; the one that is being typed into is left alone.
const show = () => {
  for (const [key] of SLIDERS) {
    const [range, exact] = byId(key).parentElement.querySelectorAll("input");
    range.value = settings[key];
    if (document.activeElement !== exact) exact.value = settings[key];
  }
  for (const key of CHOICES) byId(key).value = settings[key];
  byId("link").href = `#${new URLSearchParams(settings)}`;
};
const apply = (given) => {
  settings = given;
  byId("tau").max = settings.end_time;
  show();
  invalidate(0);
};
const fromLink = () => {
  const given = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  const read = { ...ofPaper(chosen()) };
  for (const [key, , least, most] of SLIDERS) {
    const value = Number(given[key] ?? NaN);
    const whole = key !== "half_width" && key !== "end_time" || Number.isInteger(value);
    if (value >= least && value <= most && whole) read[key] = value;
  }
  for (const key of CHOICES) {
    if ([...byId(key).options].some(({ value }) => value === given[key])) read[key] = given[key];
  }
  apply(read);
};

// --- Pictures -----------------------------------------------------------------------------------

const RAMP = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
const shade = (part) => {
  const at = Math.min(part, 1) * (RAMP.length - 1);
  const [low, rest] = [Math.min(Math.floor(at), RAMP.length - 2), at - Math.min(Math.floor(at), RAMP.length - 2)];
  return RAMP[low].map((value, i) => value + rest * (RAMP[low + 1][i] - value));
};
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
  const raw = (most - least) / count;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const step = unit * [1, 2, 5, 10].find((times) => times * unit >= raw);
  const found = [];
  for (let at = Math.ceil(least / step); at * step <= most * (1 + 1e-9); at += 1) found.push(Number((at * step).toPrecision(6)));
  return found;
};
// Draw axes from 0 to the end and from `least` to `most`; return where a point comes to lie.
const axes = (canvas, least, most, title) => {
  const { pen, width, height } = penOf(canvas);
  const [left, top, right, bottom] = [46, 24, width - 12, height - 34];
  const x = (tau) => left + ((right - left) * tau) / settings.end_time;
  const y = (value) => bottom - ((bottom - top) * (value - least)) / (most - least);
  pen.fillStyle = colour("ink");
  pen.strokeStyle = colour("rule");
  pen.textAlign = "center";
  for (const tau of ticks(0, settings.end_time, 5)) pen.fillText(tau, x(tau), bottom + 16);
  pen.fillText("τ", (left + right) / 2 + 24, bottom + 30);
  pen.textAlign = "right";
  for (const value of ticks(least, most, 5)) {
    pen.fillText(value, left - 6, y(value) + 4);
    pen.strokeRect(left, y(value), right - left, 0);
  }
  pen.textAlign = "left";
  pen.fillText(title, left, 15);
  return { pen, x, y, left, top, right, bottom };
};
const upright = ({ pen, x, top, bottom }, tau, name, dash) => {
  pen.strokeStyle = colour(name);
  pen.lineWidth = 1.5;
  pen.setLineDash(dash);
  pen.beginPath();
  pen.moveTo(x(tau), top);
  pen.lineTo(x(tau), bottom);
  pen.stroke();
  pen.setLineDash([]);
};

let run = null;
let other = null;
let state = null;
const horizon = () => (isOf(chosen()) ? chosen().horizon[settings.solver] : null);

const drawNorm = (norm, title) => {
  const curves = [...run[norm], ...(other ? other[norm] : [])];
  const plot = axes(byId(norm), 0, Math.max(...curves.map((values) => values.reduce((a, b) => Math.max(a, b))), 1e-9), title);
  curves.forEach((values, i) => {
    plot.pen.strokeStyle = colour(i % 2 ? "b" : "a");
    plot.pen.lineWidth = i < 2 ? 1.8 : 1.2;
    plot.pen.setLineDash(i < 2 ? [] : [5, 4]);
    plot.pen.beginPath();
    values.forEach((value, k) => plot.pen.lineTo(plot.x(run.tau[k]), plot.y(value)));
    plot.pen.stroke();
  });
  if (horizon()) upright(plot, horizon(), "ink", [4, 4]);
  upright(plot, Number(byId("tau").value), "link", []);
};
const drawSpacetime = () => {
  const largest = Math.max(...run.modulus.map((values) => values.reduce((a, b) => Math.max(a, b))), 1e-300);
  const shades = Array.from({ length: 256 }, (_, i) => shade(i / 255));
  ["A", "B"].forEach((name, component) => {
    const half = run.sites - 1;
    const plot = axes(byId(`spacetime${name}`), -half - 0.5, half + 0.5, `|${name}ₙ| at the pairs n, from 0 to ${largest.toPrecision(3)}`);
    const image = new ImageData(run.snapshots, 2 * half + 1);
    for (let n = -half; n <= half; n += 1) {
      for (let s = 0; s < run.snapshots; s += 1) {
        const value = run.modulus[component][Math.abs(n) * run.snapshots + s];
        image.data.set([...shades[Math.round((255 * value) / largest)], 255], 4 * ((half - n) * run.snapshots + s));
      }
    }
    const small = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    small.getContext("2d").putImageData(image, 0, 0);
    plot.pen.imageSmoothingEnabled = false;
    plot.pen.drawImage(small, plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top);
    upright(plot, Number(byId("tau").value), "cursor", []);
  });
};
const drawCurves = () => {
  drawNorm("l2", "ℓ² norms");
  drawNorm("linf", "ℓ∞ norms");
  drawSpacetime();
};

// Two rows of pendula: x = 2μ Re(A e^{iφ}) above and y below, φ the phase of the swing.
let phase = 0;
const drawPendula = () => {
  const { pen, width, height } = penOf(byId("pendula"));
  const mu = Number(byId("mu").value);
  const half = run.sites - 1;
  const [slot, length] = [width / (2 * half + 3), 0.2 * height];
  let over = 0;
  ["a", "b"].forEach((name, component) => {
    const hook = (0.25 + 0.5 * component) * height;
    for (let n = -half; n <= half; n += 1) {
      const at = Math.abs(n) + 1;
      const [re, im] = [state[component][at], state[component][state[component].length / 2 + at]];
      const angle = 2 * mu * (re * Math.cos(phase) - im * Math.sin(phase));
      const isOver = 2 * mu * Math.hypot(re, im) > Math.PI;
      over += isOver;
      const from = (n + half + 1.5) * slot;
      const [x, y] = [from + length * Math.sin(angle), hook + length * Math.cos(angle)];
      pen.strokeStyle = pen.fillStyle = colour(isOver ? "over" : name);
      pen.lineWidth = isOver ? 2.5 : 1.2;
      pen.beginPath();
      pen.moveTo(from, hook);
      pen.lineTo(x, y);
      pen.stroke();
      pen.beginPath();
      pen.arc(x, y, Math.max(2, Math.min(6, 0.45 * slot)), 0, 2 * Math.PI);
      if (isOver) pen.rect(x - 5, y - 5, 10, 10);
      pen.fill();
    }
  });
  const swings = 1 / (Math.PI * mu * mu);
  byId("swings").textContent = `μ = ${mu}: a pendulum swings about ${swings.toFixed(0)} times in a unit of τ, and once a second here. `
    + `Over the top at this τ: ${over} of ${2 * (2 * half + 1)}.`;
};

// --- What changes when a setting does, a piece in each frame ------------------------------------

const TAIL = 2;
const say = (number) => Number(number.toPrecision(4)).toString().replace("-", "−");
const tell = () => {
  const tau = Number(byId("tau").value);
  const [i, s] = [Math.round(tau / STEP.output), Math.round(tau / STEP.output / STEP.every)];
  let [near, all] = [0, 0];
  for (const half of run.modulus) {
    for (let n = 0; n < run.sites; n += 1) {
      const power = (n ? 2 : 1) * half[n * run.snapshots + s] ** 2;
      all += power;
      if (n <= TAIL) near += power;
    }
  }
  const share = all ? `${((100 * near) / all).toFixed(0)} %` : "none";
  byId("told").textContent = `At τ = ${say(tau)}: ℓ² norms ${say(run.l2[0][i])} of A and ${say(run.l2[1][i])} of B, `
    + `largest amplitudes ${say(run.linf[0][i])} and ${say(run.linf[1][i])}. ${share} of the power Σ|Aₙ|² + |Bₙ|² `
    + `${"is at the central pairs, |n| ≤ "}${TAIL}. Since τ = 0 the energy has changed by ${say(run.energy[i] - run.energy[0])}.`;
  byId("tau_said").textContent = `τ = ${say(tau)}`;
  for (const norm of ["l2", "linf"]) byId(norm).setAttribute("aria-label", `${norm === "l2" ? "ℓ²" : "ℓ∞"} norms against time; at τ = ${say(tau)} ${say(run[norm][0][i])} of A and ${say(run[norm][1][i])} of B`);
};
const tellHorizon = () => {
  const one = chosen();
  if (!isOf(one)) return "These are settings of your own, of which nothing is certified.";
  const curve = (time) => (time ? `until τ = ${say(time)}` : `to the end, τ = ${say(one.settings.end_time)}`);
  return `Certified horizon of ${one.title}: the printed line of ode45 is proved to contain the true curve ${curve(one.contained)}. `
    + `The norms of ${settings.solver} are those of the multiprecision reference ${curve(horizon())} (the dashed line).`;
};
const difference = (one, two) => {
  const parts = [...one.linf, ...one.l2].map((values, i) => [values, [...two.linf, ...two.l2][i]]);
  const scales = parts.map((pair) => Math.max(...pair.map((values) => values.reduce((a, b) => Math.max(a, b)))) || 1);
  return one.tau.findIndex((_, k) => parts.some(([p, q], i) => Math.abs(p[k] - q[k]) / scales[i] > data.visible));
};
const perturbs = () => byId("perturb").getAttribute("aria-pressed") === "true";
const perturb = () => {
  const size = 10 ** Number(byId("size").value);
  const changed = { ...settings };
  for (const key of ["a_re", "a_im", "b_re", "b_im"]) changed[key] *= 1 + size;
  other = solvers[settings.solver].solve(changed, STEP.output, 0);
  const first = difference(run, other);
  byId("parted").textContent = `Data that are larger by the factor 1 + ${size.toExponential(0)} (dashed curves): the runs part by `
    + `${100 * data.visible} % of full scale ${first < 0 ? "at no time" : `at τ = ${say(run.tau[first])}`}. ${tellHorizon()}`;
};

const stages = [
  () => {
    const start = performance.now();
    other = null;
    run = solvers[settings.solver].solve(settings, STEP.output, STEP.every);
    drawCurves();
    tell();
    byId("parted").textContent = tellHorizon();
    document.body.dataset.frame = performance.now() - start;
  },
  () => {
    if (!perturbs()) return;
    perturb();
    drawCurves();
  },
  () => {
    const tau = Number(byId("tau").value);
    state = tau ? solvers[settings.solver].solve({ ...settings, end_time: tau }, tau, 0).state : run.start;
    drawPendula();
  },
];
let stage = stages.length;
const step = () => {
  try {
    stages[stage]();
    byId("fault").textContent = "";
    stage += 1;
  } catch (fault) {
    byId("fault").textContent = fault.message;
    stage = stages.length;
  }
  if (stage < stages.length) requestAnimationFrame(step);
};
const invalidate = (from) => {
  const idle = stage >= stages.length;
  stage = Math.min(stage, from);
  if (idle) requestAnimationFrame(step);
};

// --- Play, export, and the start ----------------------------------------------------------------

const still = window.matchMedia("(prefers-reduced-motion: reduce)");
let last = null;
const moveTo = (tau) => {
  byId("tau").value = tau;
  tell();
  drawCurves();
  invalidate(2);
};
const play = (now) => {
  if (last === null) return;
  const passed = Math.min((now - last) / 1000, 0.2);
  if (!still.matches || now - last > 1000) {
    last = now;
    phase = still.matches ? 0 : phase + 2 * Math.PI * passed;
    const tau = Number(byId("tau").value) + (still.matches ? 1 : passed);
    moveTo(Math.min(tau, settings.end_time));
    if (tau >= settings.end_time) stop();
  }
  requestAnimationFrame(play);
};
const stop = () => {
  last = null;
  byId("play").textContent = "Play";
};
byId("play").addEventListener("click", () => {
  if (last !== null) return stop();
  if (Number(byId("tau").value) >= settings.end_time) byId("tau").value = 0;
  byId("play").textContent = "Pause";
  last = performance.now();
  return requestAnimationFrame(play);
});

const save = (name, text) => {
  const address = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
};
const csv = () => {
  const columns = [run.tau, ...run.l2, ...run.linf, run.energy];
  const rows = Array.from(run.tau, (_, i) => columns.map((values) => values[i]).join(","));
  return ["tau,l2_A,l2_B,linf_A,linf_B,energy", ...rows, ""].join("\n");
};
// YAML takes 1e-7 for a word: a number with an exponent needs a point
const plain = (number) => String(number).replace(/^(-?\d+)e/, "$1.0e");
const complex = (re, im) => (im ? `"${plain(re)}${im < 0 ? "" : "+"}${plain(im)}j"` : plain(re));
const yaml = () => {
  const { a_re, a_im, b_re, b_im, solver } = settings;
  const [rtol, atol] = solvers[solver].controls.map(plain);
  const numbers = ["omega", "gamma", "epsilon", "half_width"].map((key) => `    ${key}: ${plain(settings[key])}`);
  return [
    "# .venv/bin/snakemake own --configfile mine.yaml", "cases:", "  mine:", ...numbers,
    `    boundary: ${settings.boundary}`, `    initial: {0: [${complex(a_re, a_im)}, ${complex(b_re, b_im)}]}`,
    `    end_time: ${settings.end_time}`, `    output_step: ${STEP.output}`,
    `    snapshot_step: ${STEP.output * STEP.every}`, `    solver: {name: ${solver}, rtol: ${rtol}, atol: ${atol}}`, "",
  ].join("\n");
};

const listen = (id, event, act) => byId(id).addEventListener(event, act);
const begin = async () => {
  const loaded = Object.entries(data.solvers).map(([name, given]) => Solver.load(name, given));
  solvers = Object.fromEntries((await Promise.all(loaded)).map((one) => [one.name, one]));
  for (const one of data.cases) byId("case").add(new Option(one.title));
  const reset = () => {
    stop();
    byId("tau").max = chosen().settings.end_time;
    byId("tau").value = chosen().settings.end_time;
    apply(ofPaper(chosen()));
  };
  listen("case", "change", reset);
  listen("reset", "click", reset);
  for (const key of CHOICES) listen(key, "change", () => apply({ ...settings, [key]: byId(key).value }));
  listen("tau", "input", () => moveTo(byId("tau").value));
  listen("mu", "input", drawPendula);
  listen("perturb", "click", () => {
    byId("perturb").setAttribute("aria-pressed", String(!perturbs()));
    invalidate(0);
  });
  listen("size", "input", () => {
    byId("size_said").textContent = (10 ** Number(byId("size").value)).toExponential(0);
    invalidate(1);
  });
  listen("compare", "click", compareAll);
  listen("csv", "click", () => save("mine.csv", csv()));
  listen("yaml", "click", () => save("mine.yaml", yaml()));
  const redraw = () => invalidate(0);
  window.addEventListener("resize", redraw);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  const byLink = () => (location.hash === "#same-bits" ? compareAll() : fromLink());
  window.addEventListener("hashchange", byLink);
  reset();
  if (location.hash) byLink();
};
begin().catch((fault) => { byId("fault").textContent = `This browser cannot run the solvers: ${fault.message}`; });
