"use strict";

// A picture of the pendula, two rows of them; a bar at the left shows the drive, from -1 to 1.
const drawPendula = (pen, { width, height }, sites, colours, bytes, drive) => {
  const slot = width / (sites + 6);
  const length = 0.2 * height;
  pen.clearRect(0, 0, width, height);
  pen.lineWidth = 3;
  for (let row = 0; row < 2; row += 1) {
    const hook = (0.27 + 0.5 * row) * height;
    pen.strokeStyle = "#4b5364";
    pen.beginPath();
    pen.moveTo(3 * slot, hook);
    pen.lineTo(width - 3 * slot, hook);
    pen.stroke();
    pen.strokeStyle = pen.fillStyle = colours[row];
    for (let site = 0; site < sites; site += 1) {
      const angle = (((bytes[row * sites + site] << 24) >> 24) / 127) * Math.PI;
      const from = (site + 3.5) * slot;
      const [x, y] = [from + length * Math.sin(angle), hook + length * Math.cos(angle)];
      pen.beginPath();
      pen.moveTo(from, hook);
      pen.lineTo(x, y);
      pen.stroke();
      pen.beginPath();
      pen.arc(x, y, 7, 0, 2 * Math.PI);
      pen.fill();
    }
  }
  pen.fillStyle = "#4b5364";
  pen.fillRect(0.4 * slot, 0.5 * height - Math.max(0, drive) * length, 0.5 * slot, Math.abs(drive) * length);
};

// A film of the pendula: a byte for each angle, time after time.
for (const player of document.querySelectorAll(".player")) {
  const { frames, count, sites, step, period } = player.dataset;
  const bytes = Uint8Array.from(atob(frames), (letter) => letter.charCodeAt(0));
  const [last, width] = [Number(count) - 1, Number(sites)];
  const canvas = player.querySelector("canvas");
  const [button, slider, time] = ["button", "input", "output"].map((tag) => player.querySelector(tag));
  const pen = canvas.getContext("2d");
  const bobs = [...player.querySelectorAll("circle")].map((bob) => bob.getAttribute("fill"));
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  let timer = null;

  const draw = () => {
    const frame = Number(slider.value);
    const periods = frame / Number(period);
    const picture = bytes.subarray(2 * width * frame, 2 * width * (frame + 1));
    drawPendula(pen, canvas, width, [bobs[0], bobs[width]], picture, Math.cos(4 * Math.PI * periods));
    time.textContent = `${(frame * Number(step)).toFixed(1)}, ${Math.floor(periods)} periods`;
  };
  const stop = () => {
    clearInterval(timer);
    timer = null;
    button.textContent = "Play";
  };
  const advance = (by) => {
    const next = Number(slider.value) + by;
    slider.value = Math.min(next, last);
    draw();
    if (next >= last) stop();
  };
  // it starts by hand only; who wants less motion gets a picture a second, a unit of time apart
  const play = () => {
    if (Number(slider.value) >= last) slider.value = 0;
    const jump = still.matches ? Math.max(1, Math.round(1 / Number(step))) : 1;
    timer = setInterval(() => advance(jump), still.matches ? 1000 : 50);
    button.textContent = "Pause";
  };
  button.addEventListener("click", () => (timer ? stop() : play()));
  slider.addEventListener("input", draw);
  slider.value = last; // not where an earlier visit left it
  player.classList.add("live");
  draw();
}
