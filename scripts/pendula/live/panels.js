// Axes with curves against time, as the text of an SVG element of 400 by 195; pages share them.

// Write a number with a few digits and a minus sign.
const formatNumber = (number, digits = 4) => {
  const isSmall = number && Math.abs(number) < 1e-3;
  return (isSmall ? number.toExponential(2) : String(Number(number.toPrecision(digits)))).replaceAll("-", "−");
};
const polyline = (kind, ...points) => `<polyline class="${kind}" points="${points.join(" ")}"/>`;
const label = (x, y, anchor, value) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${formatNumber(value)}</text>`;
const ticks = (least, most, count) => {
  const unit = 10 ** Math.floor(Math.log10((most - least) / count));
  const step = unit * [1, 2, 5, 10].find((times) => times * unit * count >= most - least);
  const first = Math.ceil(least / step);
  return Array.from({ length: Math.floor(most / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
};

// Return axes from time 0 to `end` and from `least` to `most`. A curve is [kind, times, values], a
// band between two curves [kind, times, values, upper values], an upright line [kind, time].
const writePanel = ({ end, least, most, hasGrid }, curves, uprights) => {
  const x = (tau) => Math.round(400 + (3400 * tau) / end) / 10;
  const y = (value) => Math.round(1700 - (1600 * (value - least)) / (most - least)) / 10;
  const points = (times, values) => Array.from(values, (value, k) => [x(times[k]), y(value)]);
  const upright = (kind, tau, from, to) => polyline(kind, [x(tau), from], [x(tau), to]);
  return [
    ...ticks(least, most, 4).map((value) => polyline("rule", [36, y(value)], [hasGrid ? 380 : 40, y(value)])
      + label(34, y(value) + 4, "end", value)),
    ...ticks(0, end, 5).map((tau) => upright("rule", tau, 170, 174) + label(x(tau), 188, "middle", tau)),
    ...curves.map(([kind, times, values, upper]) => polyline(kind, ...points(times, values),
      ...(upper ? points(times, upper).reverse() : []))),
    ...uprights.map(([kind, tau]) => upright(kind, tau, 10, 170)),
  ].join("");
};
