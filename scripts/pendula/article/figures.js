// Live figures: the cases of Figs 2 to 4 integrated in the page, with the curves of the datasets.

const layers = JSON.parse(document.getElementById("layers").textContent);
const NORMS = ["linf", "l2"];
const FULL_SCALE = 65535; // the largest integer in the 16 bits of a number of a curve
const toCurve = ({ largest, values }) =>
  Float64Array.from(new Uint16Array(decodeBase64(values).buffer), (value) => (value * largest) / FULL_SCALE);
const timesOf = ({ length }, end) => Float64Array.from({ length }, (_, i) => (end * i) / (length - 1));
let solverIsLoaded; // a promise, set when the first figure is opened
const part = (section, name) => section.querySelector(`[data-part="${name}"]`);
const caseOf = (section) => data.cases.find(({ name }) => name === part(section, "case").value);
// The slider has a step for no perturbation and one for each power of ten.
const perturbationOf = (section) => {
  const { value, max } = part(section, "perturbation");
  return Number(value) ? 10 ** (Number(value) - Number(max) - 1) : 0;
};
const isShown = (section, layer) => part(section, layer).checked;

// Return ode45's run of a case, and the run from perturbed amplitudes.
const runCase = async ({ settings, output_step: outputStep }, perturbation) => {
  solverIsLoaded ??= loadSolver();
  await solverIsLoaded;
  const multiplied = { ...settings };
  for (const key of ["a_re", "a_im", "b_re", "b_im"]) multiplied[key] *= 1 + perturbation;
  return Promise.all([solve(settings, outputStep), solve(multiplied, outputStep)]);
};
// Return the curves of the chosen layers of one norm, the lowest first.
const curvesOf = (section, norm, unperturbed, run) => {
  const { reference, ensemble } = layers[caseOf(section).name];
  const end = run.tau.at(-1);
  const both = (layer, toEntry) => (isShown(section, layer) ? [0, 1].map(toEntry) : []);
  return [
    ...both("ensemble", (i) => {
      const [low, , high] = ensemble[norm][i].map(toCurve);
      return [`band ${"ab"[i]}`, timesOf(low, end), low, high];
    }),
    ...both("reference", (i) => {
      const values = toCurve(reference[norm][i]);
      return [`pale ${"ab"[i]}`, timesOf(values, end), values];
    }),
    ...both("ode45", (i) => [`dashed ${"ab"[i]}`, unperturbed.tau, unperturbed[norm][i]]),
    ...both("run", (i) => ["ab"[i], run.tau, run[norm][i]]),
  ];
};
const describeBits = ({ marks, every, name }, unperturbed) => {
  const accepted = new Uint32Array(decodeBase64(marks).buffer);
  const first = marksOf(unperturbed, every).findIndex((mark, i) => mark !== accepted[i]);
  return first < 0
    ? `Here ode45 gives the bits of trajectories/${name}.nc at all ${accepted.length} times.`
    : `Here the bits of ode45 differ from trajectories/${name}.nc from τ = ${formatNumber(unperturbed.tau[first])} on.`;
};
const describeRun = ({ horizon }, perturbation, divergence) => {
  const visible = `${100 * data.visible} % of full scale`;
  const fromReference = horizon === null || horizon >= layers.end_time
    ? "ode45 agrees with the reference to the end."
    : `ode45 differs from the reference by ${visible} at τ = ${formatNumber(horizon, 5)}.`;
  if (!perturbation) return `This run has no perturbation. ${fromReference}`;
  const when = Number.isFinite(divergence) ? `differs from ode45's by ${visible} at τ = ${formatNumber(divergence)}` : "agrees with ode45's to the end";
  return `This run starts from amplitudes times 1 + ${perturbation.toExponential(0)} and ${when}. ${fromReference}`;
};
let newest = 0; // the number of the last requested run
const drawFigure = async (section) => {
  newest += 1;
  const number = newest;
  const [chosen, perturbation] = [caseOf(section), perturbationOf(section)];
  part(section, "size").textContent = perturbation ? perturbation.toExponential(0) : "none";
  part(section, "link").href = `live.html#case=${chosen.name}&perturbation=${perturbation && perturbation.toExponential(0)}`;
  try {
    const [unperturbed, run] = await runCase(chosen, perturbation);
    if (number !== newest) return;
    const divergence = perturbation ? divergenceTime(unperturbed, run) : undefined;
    for (const norm of NORMS) {
      const curves = curvesOf(section, norm, unperturbed, run);
      const most = 1.03 * Math.max(...curves.map(([, , values, upper]) => largestOf(upper ?? values)), 1e-9);
      const size = { end: run.tau.at(-1), least: 0, most, hasGrid: true };
      part(section, norm).innerHTML = writePanel(size, curves, Number.isFinite(divergence) ? [["dotted", divergence]] : []);
    }
    part(section, "answer").textContent = `${describeRun(chosen, perturbation, divergence)} ${describeBits(chosen, unperturbed)}`;
  } catch (fault) {
    part(section, "answer").textContent = `This browser cannot run the solver: ${fault.message}`;
  }
};
for (const section of document.querySelectorAll(".run")) {
  section.hidden = false;
  section.addEventListener("toggle", () => section.open && drawFigure(section));
  section.addEventListener("input", () => drawFigure(section));
}
