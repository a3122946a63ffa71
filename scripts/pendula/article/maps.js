// The maps of fates: a click or the arrow keys choose initial amplitudes; the link or Enter opens them in the live page.

const KINDS = ["disperses", "stays localised", "moves away", "spreads"];
const fates = JSON.parse(document.getElementById("fates").textContent);
const cellsOf = (text) => Uint8Array.from(
  { length: fates.points ** 2 },
  ((bytes) => (_, i) => (bytes[i >> 2] >> (2 * (i & 3))) & 3)(decodeBase64(text)), // four cells in a byte
);
const drawMap = (canvas, cells, colours, [column, row]) => {
  Object.assign(canvas, { width: fates.points, height: fates.points });
  const pen = canvas.getContext("2d");
  for (let i = 0; i < cells.length; i += 1) {
    pen.fillStyle = colours[cells[i]];
    pen.fillRect(Math.floor(i / fates.points), fates.points - 1 - (i % fates.points), 1, 1);
  }
  pen.strokeStyle = "#d62728";
  pen.strokeRect(column - 4.5, fates.points - 1 - row - 4.5, 10, 10);
};
const startMap = (canvas, { omega, cells: text }) => {
  const cells = cellsOf(text);
  let chosen = [fates.start, fates.start].map((i) => Math.floor(i));
  const section = canvas.closest(".maps");
  const show = () => {
    const [a0, b0] = chosen.map((i) => fates.amplitudes[i]);
    const link = section.querySelector("a");
    link.href = `live.html#case=fig3_large&omega=${omega}&a_re=${a0}&b_re=${b0}&end_time=${fates.end_time}`;
    link.textContent = `Open A₀ = ${formatNumber(a0)}, B₀ = ${formatNumber(b0)} at Ω = ${formatNumber(omega)} in the live page`;
    section.querySelector("output").textContent = `This motion ${KINDS[cells[chosen[0] * fates.points + chosen[1]]]}.`;
    drawMap(canvas, cells, fates.colours, chosen);
  };
  const limit = (i) => Math.max(0, Math.min(fates.points - 1, i));
  canvas.addEventListener("click", ({ offsetX, offsetY }) => {
    const { clientWidth, clientHeight } = canvas;
    chosen = [
      limit(Math.floor((fates.points * offsetX) / clientWidth)),
      limit(fates.points - 1 - Math.floor((fates.points * offsetY) / clientHeight)),
    ];
    show();
  });
  canvas.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 10 : 1;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowDown: [0, -step], ArrowUp: [0, step] };
    if (event.key === "Enter") section.querySelector("a").click();
    if (!(event.key in moves)) return;
    event.preventDefault();
    chosen = chosen.map((i, axis) => limit(i + moves[event.key][axis]));
    show();
  });
  drawMap(canvas, cells, fates.colours, chosen);
  return show;
};
for (const section of document.querySelectorAll(".maps")) {
  section.hidden = false;
  section.addEventListener("toggle", () => {
    if (!section.open || section.dataset.started) return;
    section.dataset.started = "yes";
    const shows = [...section.querySelectorAll("canvas")].map((canvas, i) => startMap(canvas, fates.maps[i]));
    shows[0]();
  });
}
