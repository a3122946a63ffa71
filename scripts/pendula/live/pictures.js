// Pictures of the run that the page shows: curves, maps of moduli, and the pendula at one time.

let run, perturbed, divergence; // the run, one from perturbed data or null, and when the two differ
let outputIndex = 0; // of the displayed time
let phase = 0; // of the swinging pendula

// Draw axes against time in an SVG element, with curves of A and B, then of the perturbed A and B.
const drawPanel = (id, least, most, curves) => {
  const end = run.tau.at(-1);
  const horizon = horizonOfPaper();
  byId(id).innerHTML = writePanel(
    { end, least, most, hasGrid: curves.length > 0 },
    curves.map((values, i) => [`${"ab"[i % 2]} ${i < 2 ? "" : "dashed"}`, run.tau, values]),
    [
      ...(horizon && horizon < end ? [["dashed", horizon]] : []),
      ...(Number.isFinite(divergence) ? [["dotted", divergence]] : []),
      ["now", 0], // live.css moves it
    ],
  );
};
const drawNorm = (norm) => {
  const curves = [...run[norm], ...(perturbed ? perturbed[norm] : [])];
  drawPanel(norm, 0, 1.03 * Math.max(...curves.map(largestOf), 1e-9), curves);
};

// Draw the moduli at the sites n and -n, a pixel each: the larger, the more opaque.
const MOST_COLUMNS = 700; // a screen does not show more
const drawModuli = () => {
  const stride = Math.ceil(run.tau.length / MOST_COLUMNS);
  const columns = Math.ceil(run.tau.length / stride);
  const moduli = [0, 1].map((component) => Float64Array.from({ length: run.sites * columns }, (_, k) =>
    run.modulus(component, Math.floor(k / columns), (k % columns) * stride)));
  const largest = Math.max(...moduli.map(largestOf));
  moduli.forEach((values, component) => drawModulus(values, columns, largest, "AB"[component]));
};
const drawModulus = (values, columns, largest, name) => {
  const canvas = byId(`modulus${name}`);
  Object.assign(canvas, { width: columns, height: 2 * run.sites - 1 });
  const [, red, green, blue] = getComputedStyle(canvas).color.match(/(\d+), (\d+), (\d+)/);
  const pixels = new Uint32Array(canvas.width * canvas.height);
  for (let i = 0; i < pixels.length; i += 1) {
    const n = Math.abs(run.sites - 1 - Math.floor(i / columns));
    const opacity = largest && (255 * values[n * columns + (i % columns)]) / largest;
    pixels[i] = (opacity << 24) | (blue << 16) | (green << 8) | red;
  }
  const image = new ImageData(new Uint8ClampedArray(pixels.buffer), columns);
  canvas.getContext("2d").putImageData(image, 0, 0);
  byId(`scale${name}`).textContent = `|${name}ₙ| at site n, ${largest ? `up to ${formatNumber(largest)}` : "zero"}`;
  drawPanel(`axes${name}`, 0.5 - run.sites, run.sites - 0.5, []);
};

// Draw two rows of pendula: x = 2μ Re(A e^{iφ}) above, y below, where φ is the phase of the swing.
const [WIDE, HIGH, ROD, BOB] = [800, 205, 45, 4]; // of the picture, in its own units
const clearPendula = () => {
  const canvas = byId("pendula");
  const scale = (canvas.clientWidth * devicePixelRatio) / WIDE;
  const size = [Math.round(WIDE * scale), Math.round(HIGH * scale)];
  if (canvas.width !== size[0]) [canvas.width, canvas.height] = size;
  const pen = canvas.getContext("2d");
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.clearRect(0, 0, ...size);
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.font = "26px sans-serif";
  return pen;
};
// Add a pendulum to the paths of strings and of bobs; (`from`, `hook`) is the point it hangs from.
const addPendulum = (strings, bobs, from, hook, angle, isOver) => {
  const [x, y] = [from + ROD * Math.sin(angle), hook + ROD * Math.cos(angle)];
  strings.moveTo(from, hook);
  strings.lineTo(x, y);
  bobs.moveTo(x + BOB, y);
  if (isOver) bobs.rect(x - BOB - 1, y - BOB - 1, 2 * BOB + 2, 2 * BOB + 2);
  else bobs.arc(x, y, BOB, 0, 2 * Math.PI);
};
let drawPendula = () => {
  const [pen, style, pairs] = [clearPendula(), getComputedStyle(byId("pendula")), 2 * run.sites - 1];
  const swing = 2 * Number(byId("mu").value);
  const [cosine, sine] = [Math.cos(phase), Math.sin(phase)];
  const kinds = ["--a", "--b", "--over"].map(() => [new Path2D(), new Path2D()]);
  let overTheTop = 0;
  for (const component of [0, 1]) {
    for (let place = 0; place < pairs; place += 1) {
      const [re, im] = run.amplitude(component, Math.abs(place - run.sites + 1), outputIndex);
      const isOver = swing * Math.hypot(re, im) > Math.PI;
      overTheTop += isOver;
      const from = 50 + (700 * (place + 0.5)) / pairs;
      addPendulum(...kinds[isOver ? 2 : component], from, 50 + 100 * component, swing * (re * cosine - im * sine), isOver);
    }
  }
  kinds.forEach(([strings, bobs], kind) => {
    pen.strokeStyle = pen.fillStyle = style.getPropertyValue(["--a", "--b", "--over"][kind]);
    pen.stroke(strings);
    pen.fill(bobs);
    if (kind < 2) pen.fillText("AB"[kind], 4, 75 + 100 * kind);
  });
  byId("swings").textContent = `Over the top at this τ: ${overTheTop} of ${2 * pairs}.`;
};
