"use strict";

// Runs by the worker, and what is computed from them: hashes of their bits, how long the motion stays
// localised, and when two runs differ.

const data = JSON.parse(document.getElementById("data").textContent);
const largestOf = (values) => values.reduce((a, b) => Math.max(a, b), 0);
const decodeBase64 = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

const worker = new Worker(URL.createObjectURL(new Blob([document.getElementById("worker").textContent])));
const waiting = new Map(); // resolve and reject of each message that has no answer yet
let sent = 0;
worker.onmessage = ({ data: { number, run, message } }) => {
  const { resolve, reject } = waiting.get(number);
  waiting.delete(number);
  if (message) reject(new Error(message));
  else resolve(run && withViews(run));
};
worker.onerror = ({ message }) => waiting.forEach(({ reject }) => reject(new Error(message)));
const callWorker = (message) => new Promise((resolve, reject) => {
  sent += 1;
  waiting.set(sent, { resolve, reject });
  worker.postMessage({ number: sent, ...message });
});

// Split arrays of a run by component; where A = B was integrated once, both are the same array.
const withViews = (run) => {
  const { components, sites, tau, states } = run;
  const split = (values) => [0, components - 1].map((component) => {
    const length = values.length / components;
    return values.subarray(component * length, (component + 1) * length);
  });
  const parts = [0, 1].map((part) => split(states.subarray((part * states.length) / 2, ((part + 1) * states.length) / 2)));
  const amplitude = (component, site, i) => parts.map((part) => part[component][site * tau.length + i]);
  const modulus = (component, site, i) => {
    const at = site * tau.length + i;
    const [re, im] = [parts[0][component][at], parts[1][component][at]];
    return Math.sqrt(re * re + im * im);
  };
  return { sites, tau, energy: run.energy, linf: split(run.linf), l2: split(run.l2), amplitude, modulus };
};

// Solve from settings; `outputStep` is the time between two outputs.
let solve = (settings, outputStep) => callWorker({ settings, outputStep });
const loadSolver = () => callWorker({ setup: { solver: data.solver, faults: data.faults } });

// Return a hash for each output time: of the words of norms and energy, and at each `every`-th time
// also of the moduli in single precision, as stored in the datasets. If `every` is 0, of no moduli.
const marksOf = ({ tau, linf, l2, energy, sites, modulus }, every) => {
  const marks = new Uint32Array(tau.length).fill(data.hash.offset);
  const add = (values, step) => new Uint32Array(values.buffer).forEach((word, k) => {
    const i = step * Math.floor((4 * k) / values.BYTES_PER_ELEMENT);
    marks[i] = Math.imul(marks[i] ^ word, data.hash.prime);
  });
  for (const values of [...linf, ...l2, energy]) add(values.slice(), 1);
  if (!every) return marks;
  for (const component of [0, 1]) {
    for (let site = 0; site < sites; site += 1) {
      const count = Math.floor((tau.length - 1) / every) + 1;
      add(Float32Array.from({ length: count }, (_, s) => modulus(component, site, s * every)), every);
    }
  }
  return marks;
};

// Return the first time at which the central pair and its neighbours hold at most half of the power,
// among the times at which the datasets have moduli.
const endOfLocalised = ({ sites, tau, modulus }, every) => {
  const isLeft = (i) => {
    const power = (n) => modulus(0, n, i) ** 2 + modulus(1, n, i) ** 2;
    let beyond = 0;
    for (let n = 2; n < sites; n += 1) beyond += 2 * power(n);
    return power(0) + 2 * power(1) <= beyond;
  };
  return tau.find((_, i) => i % every === 0 && isLeft(i)) ?? Infinity;
};

// Return the first time at which the norms of two runs differ by the visible fraction of full scale.
const divergenceTime = (first, second) => {
  const pairs = ["linf", "l2"].flatMap((norm) => [0, 1].map((k) => [first[norm][k], second[norm][k]]));
  const limits = pairs.map((pair) => data.visible * (Math.max(...pair.map(largestOf)) || 1));
  return first.tau.find((_, i) => pairs.some(([p, q], k) => Math.abs(p[i] - q[i]) > limits[k]));
};
