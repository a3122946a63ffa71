// The controls of the page: settings, the time that is shown, the address, and playing.

const byId = (id) => document.getElementById(id);
const PARTS = ["a_re", "a_im", "b_re", "b_im"];
const SHOWN = ["mu", "perturbation", "tau"]; // parameters of a link besides the case and its settings
let settings;
let rejected = []; // messages about parts of a link that the page cannot show

const chosenCase = () => data.cases[byId("case").selectedIndex];
const isOfPaper = () => Object.entries(chosenCase().settings).every(([key, value]) => settings[key] === value);
const horizonOfPaper = () => (isOfPaper() ? chosenCase().horizon : null);
const perturbation = () => Number(byId("perturbation").value);
const shownTime = () => Number(byId("tau").value);

// --- Runs: one at a time; if settings change meanwhile, the last ones are run next --------------

let isSolving = false;
let isOutdated = false; // the settings have changed since the current run began
const update = async () => {
  isOutdated = true;
  if (isSolving) return;
  isSolving = true;
  while (isOutdated) {
    isOutdated = false;
    try {
      await integrate();
      byId("fault").textContent = rejected.join(" ");
    } catch (fault) {
      byId("fault").textContent = fault.message;
      setPlaying(null);
    }
  }
  isSolving = false;
};
const integrate = async () => {
  const { output_step: outputStep } = chosenCase();
  const multiplied = { ...settings };
  for (const part of PARTS) multiplied[part] *= 1 + perturbation();
  const runs = await Promise.all([solve(settings, outputStep), perturbation() ? solve(multiplied, outputStep) : null]);
  if (isOutdated) return;
  [run, perturbed] = runs;
  divergence = perturbed ? divergenceTime(run, perturbed) : null;
  draw();
};
const draw = () => {
  drawNorm("l2");
  drawNorm("linf");
  drawModuli();
  drawChart();
  byId("localised").textContent = describeLocalised();
  byId("parted").textContent = `${describePerturbed()} ${describeHorizon()}`;
  showTime();
};
const showTime = () => {
  byId("tau_value").textContent = `τ = ${formatNumber(shownTime())}`;
  byId("mu_value").textContent = byId("mu").value;
  byId("plots").style.setProperty("--now", shownTime() / settings.end_time);
  if (!run) return;
  outputIndex = Math.min(Math.round(((run.tau.length - 1) * shownTime()) / run.tau.at(-1)), run.tau.length - 1);
  const description = describeTime();
  byId("numbers").textContent = description;
  for (const slider of document.querySelectorAll("#tau, [role=slider]")) {
    slider.ariaValueNow = shownTime();
    slider.ariaValueMax = settings.end_time;
    slider.ariaValueText = description;
  }
  drawPendula();
};
const compareAll = async () => {
  const rows = await Promise.all(data.cases.map(async (paperCase) => {
    const marks = marksOf(await solve(paperCase.settings, paperCase.output_step), paperCase.every);
    const accepted = new Uint32Array(decodeBase64(paperCase.marks).buffer);
    const first = accepted.findIndex((mark, i) => mark !== marks[i]);
    const [className, text] = first < 0
      ? ["same", `✓ ${paperCase.title}: the same at all ${accepted.length} times`]
      : ["different", `✗ ${paperCase.title}: first differs at τ = ${Number((first * paperCase.output_step).toPrecision(12))}`];
    return Object.assign(document.createElement("li"), { className, textContent: text });
  }));
  byId("bits").replaceChildren(...rows);
  byId("same-bits").textContent = `${byId("bits").querySelectorAll(".same").length} of ${data.cases.length}`;
};

// --- Settings and the address -------------------------------------------------------------------

// Use settings, show them on all controls, and run them.
const apply = (chosen) => {
  settings = chosen;
  for (const [key, value] of Object.entries(settings)) {
    byId(key).value = value;
    if (key !== "boundary") byId(`${key}_value`).textContent = value;
  }
  byId("tau").max = settings.end_time;
  update();
};
const readControl = (key) => (key === "boundary" ? byId(key).value : Number(byId(key).value));

// Return whether a text is a number in the range of its slider; it need not be one of the steps.
const isInRange = (key, text) => {
  const { min, max, step } = byId(key);
  const number = Number(text);
  return text.trim() && number >= min && number <= max && (step < 1 || Number.isInteger(number));
};
// Set a control and return true; if it cannot show the value, report it and return false.
const setControl = (key, text) => {
  const { options, value, min, max, step } = byId(key);
  byId(key).value = text;
  const possible = options ? Array.from(options, (option) => option.value) : [`${min} to ${max} (step ${step})`];
  if (options ? possible.includes(text) : text.trim() && Number(text) === Number(byId(key).value)) return true;
  byId(key).value = value;
  rejected.push(`The link has ${key} = ${text}; this page can show ${possible.join(", ")}, and shows ${value}.`);
  return false;
};
// Show the case and settings of a link, by default the first case; without a time, play from the start.
const show = (link) => {
  const values = new URLSearchParams(link);
  const accept = (keys) => keys.filter((key) => values.has(key) && setControl(key, values.get(key)));
  const read = (key) => {
    const isExact = key !== "boundary" && isInRange(key, values.get(key) ?? "");
    if (isExact) return [[key, Number(values.get(key))]];
    return accept([key]).map(() => [key, readControl(key)]);
  };
  rejected = [];
  byId("case").selectedIndex = 0;
  accept(["case"]);
  const keys = Object.keys(chosenCase().settings);
  apply({ ...chosenCase().settings });
  apply({ ...settings, ...Object.fromEntries(keys.flatMap(read)) });
  const isPlaying = !values.has("tau") && !isStill.matches;
  byId("mu").value = 0.5 / largestOf(PARTS.map((part) => Math.abs(settings[part]))); // the largest swing begins at one radian
  byId("perturbation").value = 0;
  byId("tau").value = isPlaying ? 0 : settings.end_time;
  accept(SHOWN);
  const unknown = [...values.keys()].filter((key) => !["case", ...keys, ...SHOWN].includes(key));
  rejected.push(...unknown.map((key) => `The link has ${key}, which is not a setting.`));
  showExperiment(link);
  setPlaying(isPlaying ? performance.now() : null);
};
const linkOf = () => {
  const changed = Object.entries(settings).filter(([key, value]) => value !== chosenCase().settings[key]);
  return new URLSearchParams([["case", chosenCase().name], ...changed, ...SHOWN.map((key) => [key, byId(key).value])]);
};
// The address always names what the page shows: Back undoes a change, and a reload keeps it.
const push = () => history.pushState(null, "", `#${linkOf()}`);
const replaceAddress = () => history.replaceState(null, "", `#${linkOf()}`);
const showAndPush = (link) => {
  show(link);
  push();
};
const showExperiment = (link) => document.querySelectorAll("#experiments > div").forEach((experiment) => {
  experiment.hidden = experiment.dataset.link !== link;
});

// --- Time and playing ---------------------------------------------------------------------------

const isStill = matchMedia("(prefers-reduced-motion: reduce)");
let lastFrame = null; // time of the previous frame while playing, null otherwise
let nextFrame;
const moveTo = (tau) => {
  byId("tau").value = Math.min(Math.max(tau, 0), settings.end_time);
  showTime();
};
const setPlaying = (since) => {
  lastFrame = since;
  cancelAnimationFrame(nextFrame);
  byId("play").textContent = since === null ? "Play" : "Pause";
  if (since !== null) nextFrame = requestAnimationFrame(play);
};
const play = (time) => {
  const passed = Math.max(0, Math.min((time - lastFrame) / 1000, 0.2));
  if (!isStill.matches) phase += 2 * Math.PI * passed;
  moveTo(shownTime() + passed);
  if (shownTime() < settings.end_time) {
    setPlaying(time);
  } else {
    setPlaying(null);
    replaceAddress();
  }
};
const togglePlaying = () => {
  if (lastFrame === null && shownTime() === settings.end_time) moveTo(0);
  setPlaying(lastFrame === null ? performance.now() : null);
  if (lastFrame === null) replaceAddress();
};
// Arrows on a plot move the time by one unit, with Shift by one output.
const moveByKey = (event) => {
  const step = event.shiftKey ? chosenCase().output_step : 1;
  const times = {
    ArrowLeft: shownTime() - step, ArrowDown: shownTime() - step, Home: 0,
    ArrowRight: shownTime() + step, ArrowUp: shownTime() + step, End: settings.end_time,
  };
  if (!(event.key in times)) return;
  event.preventDefault();
  moveTo(times[event.key]);
  replaceAddress();
};
const moveByPointer = (event) => {
  const { left, width } = event.currentTarget.getBoundingClientRect();
  moveTo((settings.end_time * ((event.clientX - left) / width - 0.1)) / 0.85); // where the axis lies
  replaceAddress();
};

// --- The start ----------------------------------------------------------------------------------

const save = (download, text) => {
  const href = `data:text/plain;charset=utf-8,${encodeURIComponent(text)}`;
  Object.assign(document.createElement("a"), { href, download }).click();
};
const listen = (id, event, act) => byId(id).addEventListener(event, act);
const listenToSettings = () => {
  for (const key of Object.keys(chosenCase().settings)) {
    listen(key, "input", () => {
      rejected = [];
      apply({ ...settings, [key]: readControl(key) });
    });
    listen(key, "change", push);
  }
  const reset = () => showAndPush(`case=${byId("case").value}&perturbation=${byId("perturbation").value}`);
  listen("case", "change", reset);
  listen("reset", "click", reset);
  listen("mu", "input", showTime);
  listen("perturbation", "input", update);
  for (const id of ["mu", "perturbation"]) listen(id, "change", push);
  for (const button of document.querySelectorAll("button[data-link]")) {
    button.addEventListener("click", () => showAndPush(button.dataset.link));
  }
};
const listenToTime = () => {
  listen("tau", "input", showTime);
  listen("tau", "change", replaceAddress);
  listen("play", "click", togglePlaying);
  for (const plot of document.querySelectorAll("[role=slider]")) {
    plot.addEventListener("keydown", moveByKey);
    plot.addEventListener("pointerdown", moveByPointer);
  }
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target.closest("button, select, a, summary")) return;
    event.preventDefault();
    togglePlaying();
  });
  addEventListener("resize", () => run && drawPendula());
};
const showAddress = () => {
  if (location.hash === "#same-bits") compareAll();
  else show(location.hash.slice(1));
};
const begin = async () => {
  await loadSolver();
  data.cases.forEach(({ title, name }) => byId("case").add(new Option(title, name)));
  listenToSettings();
  listenToTime();
  listenToChart();
  listen("compare", "click", compareAll);
  listen("csv", "click", () => save("mine.csv", writeCsv()));
  listen("yaml", "click", () => save("mine.yaml", writeYaml()));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => run && draw());
  addEventListener("popstate", showAddress);
  show("");
  if (location.hash) showAddress();
};
begin().catch((fault) => {
  byId("fault").textContent = `This browser cannot run the solver: ${fault.message}`;
});
