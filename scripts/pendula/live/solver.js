// The worker: it runs the project's compiled kernel, loaded by webassembly.js of the library. The
// page stays responsive meanwhile.

const ENDS = { dirichlet: 0n, free: 1n, periodic: 1n }; // on a ring an even solution is mirrored at the end
const MIRROR = 3n; // the end at the centre of an even chain

// Return the solver as a function of settings and of the step of its outputs. A run holds, on half of
// the chain, norms (component, time), energy (time) and amplitudes (part, component, site, time).
const loadSolver = async ({ code, controls, work }, faults) => {
  const { clear, array, call } = await loadKernel(Uint8Array.from(atob(code), (letter) => letter.charCodeAt(0)));
  return (settings, outputStep) => {
    // the initial data are even: integrate half of the chain, and only A if A = B
    const start = [settings.a_re, settings.a_im, settings.b_re, settings.b_im];
    const components = start[0] === start[2] && start[1] === start[3] ? 1 : 2;
    const outputs = Math.round(settings.end_time / outputStep);
    const [sites, rows] = [settings.half_width + 1, 2 * components];
    const width = sites + 2;
    clear();
    const [outcome, y, times] = [array(5), array(rows, width), array(outputs + 1)];
    start.slice(0, rows).forEach((value, row) => { y.values[row * width + 1] = value; });
    times.values.forEach((_, i) => { times.values[i] = (settings.end_time * i) / outputs; });
    const [linf, l2] = [array(components, outputs + 1), array(components, outputs + 1)];
    const energy = array(1, outputs + 1);
    const states = array(2, components, sites, outputs + 1);
    const error = call(
      outcome, settings.epsilon, settings.gamma, settings.omega, MIRROR, ENDS[settings.boundary],
      y, times, ...controls, array(work, rows, width),
      linf, l2, states, 1n, array(2, width), energy, array(1),
    );
    const [status] = new BigInt64Array(outcome.values.buffer, outcome.place, 1);
    if (error || status) {
      throw new Error(`the run stopped at τ = ${outcome.values[1]}: ${faults[status] ?? "an error"}`);
    }
    const copies = [linf, l2, energy, states, times].map(({ values }) => values.slice());
    return { components, sites, linf: copies[0], l2: copies[1], energy: copies[2], states: copies[3], tau: copies[4] };
  };
};

let solver;
onmessage = async ({ data: { number, setup, settings, outputStep } }) => {
  try {
    if (setup) solver = loadSolver(setup.solver, setup.faults);
    const solve = await solver;
    if (setup) {
      postMessage({ number });
      return;
    }
    const run = solve(settings, outputStep);
    const buffers = Object.values(run).filter((value) => value.buffer).map((value) => value.buffer);
    postMessage({ number, run }, buffers);
  } catch (error) {
    postMessage({ number, message: error.message });
  }
};
