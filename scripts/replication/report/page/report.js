"use strict";

// Filters the claims of the report, opens the target of a link, and links the points of maps.

const form = document.querySelector(".filters");
const selects = [...form.querySelectorAll("select")];
const claims = [...document.querySelectorAll(".claim")];
const texts = new Map(claims.map((claim) => [claim, claim.textContent.toLowerCase()]));

const isMatch = (claim) => selects.every(({ id, value }) => !value || claim.dataset[id].split(id === "figure" ? " " : "\n").includes(value))
  && form.elements.search.value.toLowerCase().split(/\s+/).every((word) => texts.get(claim).includes(word));

// Hide claims that do not match, and open the sections of those that do.
const filter = () => {
  const isFiltering = selects.some(({ value }) => value) || form.elements.search.value.trim() !== "";
  for (const claim of claims) claim.hidden = isFiltering && !isMatch(claim);
  const matches = claims.filter((claim) => !claim.hidden);
  for (const section of document.querySelectorAll("section:has(.claim)")) {
    const fold = section.querySelector(":scope > details");
    const hasMatch = [...section.querySelectorAll(".claim")].some((claim) => !claim.hidden);
    if (fold && isFiltering) fold.open = hasMatch;
    section.hidden = fold !== null && !hasMatch;
  }
  document.getElementById("shown_count").textContent = isFiltering ? `${matches.length} of ${claims.length} claims` : "";
};

// Set the filters of a link, such as figure=5&verdict=confirmed.
const setFilters = (link) => {
  form.reset();
  for (const [key, value] of new URLSearchParams(link)) form.elements[key].value = value;
  filter();
};

// Show the target of the address, even if it is folded or hidden by a filter.
const showTarget = () => {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  if (target.hidden || target.closest("[hidden]")) setFilters("");
  for (let part = target; part; part = part.parentElement) {
    if (part.tagName === "DETAILS") part.open = true;
  }
  if (target.tagName === "SECTION") target.querySelector("details")?.setAttribute("open", "");
  target.scrollIntoView();
};

// Make a link of each point of a panel of a figure; arrow keys or the pointer choose the point.
const startMap = (map) => {
  const read = (name) => map.dataset[name].split(" ");
  const limits = [read("x"), read("y")].map((ends) => ends.map(Number));
  const steps = limits.map(([first, last]) => 10 ** Math.floor(Math.log10((last - first) / 100)));
  const [link, mark] = ["a", "i"].map((tag) => document.createElement(tag));
  const chosenText = map.closest("figure").querySelector(".chosen output");
  let chosen;
  const choose = (point) => {
    chosen = point.map((value, i) => {
      const [first, last] = limits[i];
      const inside = Math.max(first, Math.min(last, value));
      return Number((Math.round(inside / steps[i]) * steps[i]).toPrecision(6));
    });
    link.href = map.dataset.address.replace("{x}", chosen[0]).replace("{y}", chosen[1]);
    chosenText.textContent = read("names").map((name, i) => `${name} = ${chosen[i]}`).join(", ");
    link.ariaLabel = chosenText.textContent;
    const [across, up] = chosen.map((value, i) => (value - limits[i][0]) / (limits[i][1] - limits[i][0]));
    Object.assign(mark.style, { left: `${100 * across}%`, top: `${100 * (1 - up)}%` });
  };
  const chooseByPointer = ({ clientX, clientY }) => {
    const { left, top, width, height } = map.getBoundingClientRect();
    const parts = [(clientX - left) / width, 1 - (clientY - top) / height];
    choose(limits.map(([first, last], i) => first + parts[i] * (last - first)));
  };
  const chooseByKey = (event) => {
    const count = event.shiftKey ? 10 : 1;
    const moves = { ArrowLeft: [-count, 0], ArrowRight: [count, 0], ArrowDown: [0, -count], ArrowUp: [0, count] };
    if (!(event.key in moves)) return;
    event.preventDefault();
    choose(chosen.map((value, i) => value + moves[event.key][i] * steps[i]));
  };
  for (const kind of ["pointermove", "pointerdown"]) link.addEventListener(kind, chooseByPointer);
  link.addEventListener("keydown", chooseByKey);
  const [left, top, width, height] = read("box").map((part) => `${part}%`);
  Object.assign(map.style, { left, top, width, height });
  choose(limits.map(([first, last]) => (first + last) / 2));
  chosenText.textContent = "";
  map.append(link, mark);
  map.hidden = false;
};
for (const map of document.querySelectorAll(".map")) startMap(map);
for (const text of document.querySelectorAll(".chosen")) text.hidden = false;

form.hidden = false;
form.addEventListener("input", filter);
form.addEventListener("submit", (event) => event.preventDefault());
form.addEventListener("reset", () => setTimeout(filter));
for (const link of document.querySelectorAll("a[data-filter]")) {
  link.addEventListener("click", (event) => {
    event.preventDefault();
    setFilters(link.dataset.filter);
    form.scrollIntoView();
  });
}
addEventListener("hashchange", showTarget);
document.addEventListener("click", ({ target }) => {
  if (target.hash && target.hash === location.hash) showTarget(); // the address stays the same
});
showTarget();
