// The chart of stability: where the chain at rest is unstable; a click, or arrows, choose Ω and γ.

const RATE_LEVELS = 255; // of the growth rates in the data
const chartAxes = () => [["omega", data.chart.omega], ["gamma", data.chart.gamma]];
const drawChart = () => {
  const { rates } = data.chart;
  const [columns, rows] = chartAxes().map(([, values]) => values.length);
  const canvas = byId("chart");
  const [wide, high] = [canvas.width / columns, canvas.height / rows];
  const pen = canvas.getContext("2d");
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = getComputedStyle(canvas).color;
  rates.forEach((rate, i) => {
    pen.globalAlpha = rate / RATE_LEVELS;
    pen.fillRect(Math.floor(i / rows) * wide, (rows - 1 - (i % rows)) * high, wide, high);
  });
  pen.globalAlpha = 1;
  const [x, y] = chartAxes().map(([key, values]) => (settings[key] - values[0]) / (values.at(-1) - values[0]));
  pen.strokeStyle = pen.fillStyle;
  pen.lineWidth = 3;
  pen.beginPath();
  pen.arc(wide / 2 + x * (canvas.width - wide), canvas.height - high / 2 - y * (canvas.height - high), 8, 0, 2 * Math.PI);
  pen.stroke();
};
// Set Ω and γ to values on the chart, by the steps of their sliders.
const chooseOnChart = (values) => {
  const chosen = chartAxes().map(([key, axis], i) => {
    const step = Number(byId(key).step);
    const value = Math.max(axis[0], Math.min(axis.at(-1), values[i]));
    return [key, Number((Math.round(value / step) * step).toFixed(6))];
  });
  apply({ ...settings, ...Object.fromEntries(chosen) });
  push();
};
const listenToChart = () => {
  const canvas = byId("chart");
  canvas.addEventListener("click", ({ offsetX, offsetY }) => {
    const parts = [offsetX / canvas.clientWidth, 1 - offsetY / canvas.clientHeight];
    chooseOnChart(chartAxes().map(([, values], i) => {
      const cell = values[1] - values[0];
      return values[0] - cell / 2 + parts[i] * (values.at(-1) - values[0] + cell);
    }));
  });
  canvas.addEventListener("keydown", (event) => {
    const moves = { ArrowLeft: [-0.5, 0], ArrowRight: [0.5, 0], ArrowDown: [0, -0.25], ArrowUp: [0, 0.25] };
    if (!(event.key in moves)) return;
    event.preventDefault();
    chooseOnChart(moves[event.key].map((move, i) => settings[chartAxes()[i][0]] + move));
  });
};
