"use strict";

// The filter of the claims: verdicts that are ticked, and words that the row holds.
for (const form of document.querySelectorAll("form.filter")) {
  const rows = [...document.querySelectorAll(".claim")];
  const ticks = [...form.querySelectorAll("input[type=checkbox]")];
  const words = form.querySelector("input[type=search]");
  const told = form.querySelector("output");
  const filter = () => {
    const shown = new Set(ticks.filter((tick) => tick.checked).map((tick) => tick.value));
    const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !(shown.has(row.dataset.verdict) && wanted.every((word) => text.includes(word)));
      count += !row.hidden;
    }
    told.textContent = `${count} of ${rows.length} claims shown`;
  };
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  // a link to a claim that is filtered away shows all again
  window.addEventListener("hashchange", () => {
    const row = document.getElementById(location.hash.slice(1));
    if (row && row.hidden) {
      for (const tick of ticks) tick.checked = true;
      words.value = "";
      filter();
      row.scrollIntoView();
    }
  });
  form.hidden = false;
  filter();
}

// A picture of |A| upwards and |B| downwards, a bar for each site.
const drawBars = (pen, { width, height }, sites, colours, bytes) => {
  const [slot, middle] = [width / sites, height / 2];
  for (let row = 0; row < 2; row += 1) {
    pen.fillStyle = colours[row];
    for (let site = 0; site < sites; site += 1) {
      const size = (bytes[row * sites + site] / 255) * (middle - 10);
      pen.fillRect((site + 0.1) * slot, row ? middle : middle - size, 0.8 * slot, size);
    }
  }
  pen.fillStyle = "#4b5364";
  pen.fillRect(0, middle - 1, width, 2);
};

// A picture of the pendula, two rows of them; a bar at the left shows the drive, from -1 to 1.
const drawPendula = (pen, { width, height }, sites, colours, bytes, drive) => {
  const slot = width / (sites + 6);
  const length = 0.2 * height;
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

// A run of the chain: bytes of |A| and |B|, or of angles, on every site, time after time.
for (const player of document.querySelectorAll(".player")) {
  const { frames, count, sites, step, still: shown, period } = player.dataset;
  const bytes = Uint8Array.from(atob(frames), (letter) => letter.charCodeAt(0));
  const [last, width] = [Number(count) - 1, Number(sites)];
  const canvas = player.querySelector("canvas");
  const [button, slider, told] = ["button", "input", "output"].map((tag) => player.querySelector(tag));
  const pen = canvas.getContext("2d");
  const bars = [...player.querySelectorAll("rect, circle")].map((bar) => bar.getAttribute("fill"));
  const colours = [bars[0], bars[width]];
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  let timer = null;

  const draw = () => {
    const frame = Number(slider.value);
    const picture = bytes.subarray(2 * width * frame, 2 * width * (frame + 1));
    const tau = (frame * Number(step)).toFixed(1);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    if (period) {
      const periods = frame / Number(period);
      drawPendula(pen, canvas, width, colours, picture, Math.cos(4 * Math.PI * periods));
      told.textContent = `${tau}, ${Math.floor(periods)} periods`;
    } else {
      drawBars(pen, canvas, width, colours, picture);
      told.textContent = tau;
    }
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
  slider.value = shown; // not where an earlier visit left it
  player.classList.add("live");
  draw();
}

// What is folded is printed too, the longest table apart.
const folded = [...document.querySelectorAll("details:not([open], .unprinted)")];
window.addEventListener("beforeprint", () => folded.forEach((one) => (one.open = true)));
window.addEventListener("afterprint", () => folded.forEach((one) => (one.open = false)));
