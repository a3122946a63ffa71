"use strict";

// Filters the claims of the report, and opens what a link leads to.

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

// Show what the address names, even in a folded part or behind a filter.
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
