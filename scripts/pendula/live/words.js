// Sentences about a run.

const untilTime = (time, digits) => (time < settings.end_time ? `until τ = ${formatNumber(time, digits)}` : "to the end");
const describeLocalised = () => {
  if (!largestOf(run.linf.map(largestOf))) return "The chain is at rest.";
  if (settings.half_width < 3) return "On so short a chain no motion counts as localised.";
  const end = endOfLocalised(run, chosenCase().every || 1);
  return end ? `The motion stays localised ${untilTime(end)}.` : "The motion is not localised at any time.";
};
const describeHorizon = () => {
  if (!isOfPaper()) return "There is no multiprecision reference for your own settings.";
  const known = horizonOfPaper() === null ? "at no known time" : untilTime(horizonOfPaper(), 5);
  const dashed = known.startsWith("until") ? " (the dashed line)" : "";
  return `Horizon of ${chosenCase().title}: the norms by ode45 are within ${100 * data.visible} % of the `
    + `multiprecision reference ${known}${dashed}.`;
};
const describePerturbed = () => {
  if (!perturbed) return "";
  const when = Number.isFinite(divergence) ? `at τ = ${formatNumber(divergence)} (the dotted line)` : "at no time";
  return `If the initial data are multiplied by the factor 1 + ${perturbation().toExponential(0)} (dashed curves), `
    + `the norms differ by ${100 * data.visible} % of full scale ${when}.`;
};
const describeTime = () => {
  const norms = ["l2", "linf"].map((norm) =>
    `${formatNumber(run[norm][0][outputIndex])} of A and ${formatNumber(run[norm][1][outputIndex])} of B`);
  return `At τ = ${formatNumber(run.tau[outputIndex])}: ℓ² norms ${norms[0]}, largest amplitudes ${norms[1]}. `
    + `The energy has changed by ${formatNumber(run.energy[outputIndex] - run.energy[0])} since τ = 0.`;
};

// Files to download: the norms as CSV, and the case as YAML.
const writeCsv = () => {
  const columns = [run.tau, ...run.l2, ...run.linf, run.energy];
  const rows = Array.from(run.tau, (_, i) => columns.map((values) => values[i]));
  return ["tau,l2_A,l2_B,linf_A,linf_B,energy", ...rows, ""].join("\n");
};
const writeComplex = (re, im) => (im ? `"${re}${im < 0 ? "" : "+"}${im}j"` : re);
const writeYaml = () => {
  const { a_re, a_im, b_re, b_im, ...keys } = settings;
  keys.initial = `{0: [${writeComplex(a_re, a_im)}, ${writeComplex(b_re, b_im)}]}`;
  const { output_step, every } = chosenCase();
  Object.assign(keys, { output_step, snapshot_step: output_step * (every || 1), solver: data.solver.named });
  const lines = Object.entries(keys).map(([key, value]) => `    ${key}: ${value}`);
  return ["# snakemake own --configfile mine.yaml", "cases:", "  mine:", ...lines, ""].join("\n");
};
