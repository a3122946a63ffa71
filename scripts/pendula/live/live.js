const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const made = (tag, properties) => Object.assign(document.createElement(tag), properties);
const largestOf = (values) => values.reduce((a, b) => Math.max(a, b), 0);

// --- The solver: the project's compiled kernel, which webassembly.js of the library loads -------

const ENDS = { dirichlet: 0n, free: 1n, periodic: 1n }; // an even solution on a ring sees itself
const MIRROR = 3n; // the end at the centre of an even chain
const PARTS = ["a_re", "a_im", "b_re", "b_im"];
const decoded = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

// Return the solver as a function of settings, the step of its outputs, and how many of these lie
// between two snapshots of the moduli (0: there are none).
const load = async ({ code, controls, work }) => {
  const { clear, array, call } = await loadKernel(decoded(code));
  return (given, { output_step: outputStep, every }) => {
    // half of the chain, since the data are even, and A alone where A = B
    const start = PARTS.map((part) => given[part]);
    const components = start[0] === start[2] && start[1] === start[3] ? 1 : 2;
    const outputs = Math.round(given.end_time / outputStep);
    const [sites, rows] = [given.half_width + 1, 2 * components];
    const [width, snapshots] = [sites + 2, every ? Math.floor(outputs / every) + 1 : 0];
    clear();
    const [outcome, y, times] = [array(5), array(rows, width), array(outputs + 1)];
    start.slice(0, rows).forEach((value, row) => { y.values[row * width + 1] = value; });
    times.values.forEach((_, i) => { times.values[i] = (given.end_time * i) / outputs; });
    const [linf, l2] = [array(components, outputs + 1), array(components, outputs + 1)];
    const energy = array(outputs + 1);
    const modulus = array(components, sites, snapshots);
    const error = call(
      outcome, given.epsilon, given.gamma, given.omega, MIRROR, ENDS[given.boundary],
      y, times, ...controls, array(work, rows, width),
      linf, l2, energy, modulus, BigInt(every), array(2, width), array(1),
    );
    const [status] = new BigInt64Array(outcome.values.buffer, outcome.place, 1);
    if (error || status) {
      throw new Error(`the run stopped at τ = ${outcome.values[1]}: ${data.faults[status] ?? "an error"}`);
    }
    const both = ({ values }) => [0, components - 1].map((component) => {
      const length = values.length / components;
      return values.slice(component * length, (component + 1) * length);
    });
    const kept = { linf: both(linf), l2: both(l2), modulus: both(modulus), state: both(y) };
    return { ...kept, tau: times.values.slice(), energy: energy.values.slice(), sites, snapshots, every };
  };
};

// --- The same bits? -----------------------------------------------------------------------------

// A hash for each output time, over the words of its norms, its energy and, if they are kept, moduli.
const marksOf = ({ tau, linf, l2, energy, modulus, snapshots, every }) => {
  const marks = new Uint32Array(tau.length).fill(data.hash.offset);
  const add = (values, step) => new Uint32Array(values.buffer).forEach((word, k) => {
    const i = step * Math.floor((4 * k) / values.BYTES_PER_ELEMENT);
    marks[i] = Math.imul(marks[i] ^ word, data.hash.prime);
  });
  for (const values of [...linf, ...l2, energy]) add(values, 1);
  for (const half of modulus) { // in single precision, as the datasets have them
    for (let k = 0; k < half.length; k += snapshots) add(new Float32Array(half.slice(k, k + snapshots)), every);
  }
  return marks;
};
const compareAll = () => {
  byId("bits").replaceChildren(...data.cases.map((one) => {
    const run = solve(one.settings, one);
    const [marks, accepted] = [marksOf(run), new Uint32Array(decoded(one.marks).buffer)];
    const first = accepted.findIndex((mark, i) => mark !== marks[i]);
    const [className, found] = first < 0
      ? ["same", `✓ ${one.title}: the same at all ${accepted.length} times`]
      : ["other", `✗ ${one.title}: first differs at τ = ${run.tau[first]}`];
    return made("li", { className, textContent: found });
  }));
  byId("same-bits").textContent = `${byId("bits").querySelectorAll(".same").length} of ${data.cases.length}`;
};

// --- Settings -----------------------------------------------------------------------------------

let solve, settings;
let refused = []; // what the page cannot do of a link
const KEPT = ["mu", "perturbation", "tau"]; // what a link holds beside the case and its settings
const chosen = () => data.cases[byId("case").selectedIndex];
const steps = () => ({ ...chosen(), every: chosen().every || 1 }); // a picture needs the moduli
const isOfPaper = () => Object.entries(chosen().settings).every(([key, value]) => settings[key] === value);

// Take settings, and let all controls show them.
const apply = (given) => {
  settings = given;
  for (const [key, value] of Object.entries(settings)) {
    byId(key).value = value;
    if (key !== "boundary") byId(`${key}_said`).textContent = value;
  }
  byId("tau").max = settings.end_time;
  update();
};
const taken = (key) => (key === "boundary" ? byId(key).value : Number(byId(key).value));

// Set a control; if it would silently show something else, let the page say so, and return false.
const set = (key, text) => {
  const { options, value, min, max, step } = byId(key);
  byId(key).value = text;
  const possible = options ? Array.from(options, (one) => one.value) : [`${min} to ${max} (step ${step})`];
  if (options ? possible.includes(text) : text.trim() && Number(text) === Number(byId(key).value)) return true;
  byId(key).value = value;
  refused.push(`The link says ${key} = ${text}; this page can show ${possible.join(", ")}, and shows ${value}.`);
  return false;
};
// Show what a link names of a case, or of the first one; without a time, play it from the start.
const show = (link) => {
  const given = new URLSearchParams(link);
  const takenOf = (keys) => keys.filter((key) => given.has(key) && set(key, given.get(key)));
  refused = [];
  byId("case").selectedIndex = 0;
  takenOf(["case"]);
  const keys = Object.keys(chosen().settings);
  apply({ ...chosen().settings });
  apply({ ...settings, ...Object.fromEntries(takenOf(keys).map((key) => [key, taken(key)])) });
  const isPlaying = !given.has("tau") && !isStill.matches;
  byId("mu").value = 0.5 / largestOf(PARTS.map((part) => Math.abs(settings[part]))); // it begins with a radian
  byId("perturbation").value = 0;
  byId("tau").value = isPlaying ? 0 : settings.end_time;
  takenOf(KEPT);
  const unknown = [...given.keys()].filter((key) => !["case", ...keys, ...KEPT].includes(key));
  refused.push(...unknown.map((key) => `The link says ${key}, which is no setting.`));
  setPlaying(isPlaying ? performance.now() : null);
};
const linkOf = () => {
  const own = Object.entries(settings).filter(([key, value]) => value !== chosen().settings[key]);
  return new URLSearchParams([["case", chosen().name], ...own, ...KEPT.map((key) => [key, byId(key).value])]);
};

// --- Pictures -----------------------------------------------------------------------------------

let run, other, parted;
const now = () => Number(byId("tau").value);
const horizon = () => (isOfPaper() ? chosen().horizon : null);
const say = (number, digits = 4) => {
  const small = number && Math.abs(number) < 1e-3;
  return (small ? number.toExponential(2) : String(Number(number.toPrecision(digits)))).replaceAll("-", "−");
};
const line = (kind, ...points) => `<polyline class="${kind}" points="${points.join(" ")}"/>`;
const label = (x, y, anchor, said) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${say(said)}</text>`;
const ticks = (least, most, count) => {
  const unit = 10 ** Math.floor(Math.log10((most - least) / count));
  const step = unit * [1, 2, 5, 10].find((times) => times * unit * count >= most - least);
  const first = Math.ceil(least / step);
  return Array.from({ length: Math.floor(most / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
};
// Draw axes against time, from least to most upwards, the curves, and marks of some times.
const drawPanel = (id, least, most, curves) => {
  const x = (tau) => Math.round(400 + (3400 * tau) / settings.end_time) / 10;
  const y = (value) => Math.round(1700 - (1600 * (value - least)) / (most - least)) / 10;
  const upright = (kind, tau, from, to) => line(kind, [x(tau), from], [x(tau), to]);
  byId(id).innerHTML = [
    ...ticks(least, most, 4).map((value) => line("rule", [36, y(value)], [curves.length ? 380 : 40, y(value)])
      + label(34, y(value) + 4, "end", value)),
    ...ticks(0, settings.end_time, 5).map((tau) => upright("rule", tau, 170, 174) + label(x(tau), 188, "middle", tau)),
    ...curves.map((values, i) => line(`${"ab"[i % 2]} ${i < 2 ? "" : "dashed"}`,
      ...Array.from(values, (value, k) => [x(run.tau[k]), y(value)]))),
    horizon() && horizon() < settings.end_time ? upright("dashed", horizon(), 10, 170) : "",
    parted ? upright("dotted", parted, 10, 170) : "",
    upright("now", 0, 10, 170), // live.css moves it
  ].join("");
};
const drawNorm = (norm) => {
  const curves = [...run[norm], ...(other ? other[norm] : [])];
  drawPanel(norm, 0, 1.03 * Math.max(...curves.map(largestOf), 1e-9), curves);
};
// Draw the moduli at the sites n and -n, a pixel each: the larger one is, the less paper shows through.
const drawModulus = (half, name, largest) => {
  const canvas = byId(`modulus${name}`);
  Object.assign(canvas, { width: run.snapshots, height: 2 * run.sites - 1 });
  const [, red, green, blue] = getComputedStyle(canvas).color.match(/(\d+), (\d+), (\d+)/);
  const pixels = new Uint32Array(canvas.width * canvas.height);
  for (let i = 0; i < pixels.length; i += 1) {
    const n = Math.abs(run.sites - 1 - Math.floor(i / run.snapshots));
    const opacity = (255 * half[n * run.snapshots + (i % run.snapshots)]) / largest;
    pixels[i] = (opacity << 24) | (blue << 16) | (green << 8) | red;
  }
  const image = new ImageData(new Uint8ClampedArray(pixels.buffer), canvas.width);
  canvas.getContext("2d").putImageData(image, 0, 0);
  byId(`scale${name}`).textContent = `|${name}ₙ| at site n, up to ${say(largest)}`;
  drawPanel(`axes${name}`, 0.5 - run.sites, run.sites - 0.5, []);
};

// Two rows of pendula: x = 2μ Re(A e^{iφ}) above, y below, and φ is the phase of the swing.
let state;
let phase = 0;
const drawPendula = () => {
  const [mu, pairs] = [Number(byId("mu").value), 2 * settings.half_width + 1];
  const drawn = ["A", "B"].map((name, row) => `<text class="${"ab"[row]}" x="4" y="${75 + 100 * row}">${name}</text>`);
  state.forEach((rows, component) => {
    for (let place = 0; place < pairs; place += 1) {
      const at = Math.abs(place - settings.half_width) + 1;
      const [re, im] = [rows[at], rows[rows.length / 2 + at]];
      const angle = 2 * mu * (re * Math.cos(phase) - im * Math.sin(phase));
      const [from, hook] = [50 + (700 * (place + 0.5)) / pairs, 50 + 100 * component];
      const [x, y] = [from + 45 * Math.sin(angle), hook + 45 * Math.cos(angle)];
      const isOver = 2 * mu * Math.hypot(re, im) > Math.PI;
      const bob = isOver ? `<rect x="${x - 5}" y="${y - 5}" width="10" height="10"/>` : `<circle cx="${x}" cy="${y}" r="4"/>`;
      drawn.push(`<g class="${isOver ? "over" : "ab"[component]}">${line("", [from, hook], [x, y])}${bob}</g>`);
    }
  });
  byId("pendula").innerHTML = drawn.join("");
  const over = drawn.filter((one) => one.includes("rect")).length;
  byId("mu_said").textContent = mu;
  byId("swings").textContent = `Over the top at this τ: ${over} of ${2 * pairs}.`;
};

// --- Words --------------------------------------------------------------------------------------

// Return the first time at which the central pair and its neighbours hold at most half of the power.
const endOfLocalised = ({ modulus, sites, snapshots, tau, every }) => {
  const isLeft = (s) => {
    const power = (n) => modulus[0][n * snapshots + s] ** 2 + modulus[1][n * snapshots + s] ** 2;
    let others = 0;
    for (let n = 2; n < sites; n += 1) others += 2 * power(n);
    return power(0) + 2 * power(1) <= others;
  };
  return tau.find((_, i) => i % every === 0 && isLeft(i / every)) ?? Infinity;
};
const until = (time, digits) => (time < settings.end_time ? `until τ = ${say(time, digits)}` : "to the end");
const tell = () => {
  const i = Math.round(((run.tau.length - 1) * now()) / settings.end_time);
  const norms = ["l2", "linf"].map((norm) => `${say(run[norm][0][i])} of A and ${say(run[norm][1][i])} of B`);
  byId("numbers").textContent = `At τ = ${say(now())}: ℓ² norms ${norms[0]}, largest amplitudes ${norms[1]}. `
    + `The energy has changed by ${say(run.energy[i] - run.energy[0])} since τ = 0.`;
  byId("tau_said").textContent = `τ = ${say(now())}`;
  byId("link").href = `#${linkOf()}`;
};
const tellLocalised = () => (settings.half_width > 2 ? `The motion stays localised ${until(endOfLocalised(run))}.`
  : "On so short a chain no motion counts as localised.");
const tellHorizon = () => {
  if (!isOfPaper()) return "There is no multiprecision reference for your own settings.";
  const known = horizon() === null ? "at no known time" : until(horizon(), 5);
  const dashed = known.startsWith("until") ? " (the dashed line)" : "";
  return `Horizon of ${chosen().title}: the norms by ode45 are within ${100 * data.visible} % of the `
    + `multiprecision reference ${known}${dashed}.`;
};
// Return the first time at which the norms of two runs differ by the visible part of full scale.
const partingOf = (one, two) => {
  const pairs = ["linf", "l2"].flatMap((norm) => [0, 1].map((k) => [one[norm][k], two[norm][k]]));
  const limits = pairs.map((pair) => data.visible * (Math.max(...pair.map(largestOf)) || 1));
  return one.tau.find((_, i) => pairs.some(([p, q], k) => Math.abs(p[i] - q[i]) > limits[k]));
};
const perturb = () => {
  const [changed, size] = [{ ...settings }, Number(byId("perturbation").value)];
  [other, parted] = [null, null];
  if (!size) return "";
  for (const part of PARTS) changed[part] *= 1 + size;
  other = solve(changed, steps());
  parted = partingOf(run, other);
  const when = parted ? `at τ = ${say(parted)} (the dotted line)` : "at no time";
  return `If the initial data are multiplied by the factor 1 + ${size.toExponential(0)} (dashed curves), `
    + `the norms differ by ${100 * data.visible} % of full scale ${when}.`;
};

// --- What a change of the settings, or of the time, changes ------------------------------------

const updateTime = () => {
  tell();
  byId("plots").style.setProperty("--now", now() / settings.end_time);
  const tau = Math.max(now(), 1e-6); // a run has a length
  const toTau = () => solve({ ...settings, end_time: tau }, { output_step: tau, every: 0 });
  ({ state } = tau < settings.end_time ? toTau() : run);
  drawPendula();
};
const draw = () => {
  drawNorm("l2");
  drawNorm("linf");
  const largest = Math.max(...run.modulus.map(largestOf), 1e-300);
  run.modulus.forEach((half, component) => drawModulus(half, "AB"[component], largest));
  updateTime();
};
let asked = false;
const answer = () => {
  asked = false;
  try {
    run = solve(settings, steps());
    byId("parted").textContent = `${perturb()} ${tellHorizon()}`;
    byId("localised").textContent = tellLocalised();
    draw();
    byId("fault").textContent = refused.join(" ");
  } catch (fault) {
    byId("fault").textContent = fault.message;
    setPlaying(null);
  }
};
const update = () => {
  if (!asked) requestAnimationFrame(answer);
  asked = true;
};
const moveTo = (tau) => {
  byId("tau").value = tau;
  updateTime();
};

// --- Play, export, and the start ----------------------------------------------------------------

const isStill = matchMedia("(prefers-reduced-motion: reduce)");
let last = null; // the time of the picture before, while it plays
let next; // the picture after
const setPlaying = (since) => {
  last = since;
  cancelAnimationFrame(next);
  byId("play").textContent = since === null ? "Play" : "Pause";
  byId("numbers").ariaLive = since === null ? "polite" : "off";
  if (since !== null) next = requestAnimationFrame(play);
};
const play = (time) => {
  const passed = Math.max(0, Math.min((time - last) / 1000, 0.2));
  if (!isStill.matches) phase += 2 * Math.PI * passed;
  moveTo(now() + passed);
  setPlaying(now() < settings.end_time ? time : null);
};
const save = (download, text) => {
  made("a", { href: `data:text/plain;charset=utf-8,${encodeURIComponent(text)}`, download }).click();
};
const csv = () => {
  const columns = [run.tau, ...run.l2, ...run.linf, run.energy];
  const rows = Array.from(run.tau, (_, i) => columns.map((values) => values[i]));
  return ["tau,l2_A,l2_B,linf_A,linf_B,energy", ...rows, ""].join("\n");
};
const complex = (re, im) => (im ? `"${re}${im < 0 ? "" : "+"}${im}j"` : re);
const yaml = () => {
  const { a_re, a_im, b_re, b_im, ...keys } = settings;
  keys.initial = `{0: [${complex(a_re, a_im)}, ${complex(b_re, b_im)}]}`;
  const { output_step, every } = steps();
  Object.assign(keys, { output_step, snapshot_step: output_step * every, solver: data.solver.named });
  const lines = Object.entries(keys).map(([key, value]) => `    ${key}: ${value}`);
  return ["# snakemake own --configfile mine.yaml", "cases:", "  mine:", ...lines, ""].join("\n");
};
const begin = async () => {
  solve = await load(data.solver);
  data.cases.forEach(({ title, name }) => byId("case").add(new Option(title, name)));
  const listen = (id, event, act) => byId(id).addEventListener(event, act);
  for (const key of Object.keys(chosen().settings)) {
    listen(key, "input", () => {
      refused = [];
      apply({ ...settings, [key]: taken(key) });
    });
  }
  const reset = () => show(`case=${byId("case").value}&perturbation=${byId("perturbation").value}`);
  listen("case", "change", reset);
  listen("reset", "click", reset);
  document.querySelectorAll("[data-link]").forEach((one) => one.addEventListener("click", () => show(one.dataset.link)));
  listen("tau", "input", updateTime);
  listen("play", "click", () => {
    byId("stage").scrollIntoView({ block: "nearest" });
    if (last === null && now() === settings.end_time) moveTo(0);
    setPlaying(last === null ? performance.now() : null);
  });
  listen("mu", "input", updateTime);
  listen("perturbation", "input", update);
  listen("compare", "click", compareAll);
  listen("csv", "click", () => save("mine.csv", csv()));
  listen("yaml", "click", () => save("mine.yaml", yaml()));
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", update);
  const byLink = () => (location.hash === "#same-bits" ? compareAll() : show(location.hash.slice(1)));
  window.addEventListener("hashchange", byLink);
  show("");
  if (location.hash) byLink();
};
begin().catch((fault) => {
  byId("fault").textContent = `This browser cannot run the solver: ${fault.message}`;
});
