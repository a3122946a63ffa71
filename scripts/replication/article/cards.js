"use strict";
// Shows a card next to a link: the source of a number, verdict or figure, or a copy of the reference,
// figure or table that the text mentions.

const panel = document.getElementById("panel");
const HOVER_DELAY = 150; // ms; a pointer that stays for less is only passing
const LEAVE_DELAY = 300; // ms, in which the pointer may move from a number into its card
const MARGIN = 8; // pixels around a card
let owner = null; // the link of the open card
let isPinned = false; // whether a click or a key opened the card, which then stays until it is closed
let timer;

const targetOf = (link) => document.getElementById(decodeURIComponent(link.hash.slice(1)));
// Return a copy of a link's target without its ids, which must be unique in the page.
const copyOf = (link) => {
  const target = targetOf(link);
  const isCard = target.classList.contains("card");
  const copy = (isCard ? target : target.closest("figure, p, [role=region]") ?? target).cloneNode(true);
  for (const element of [copy, ...copy.querySelectorAll("[id]")]) element.removeAttribute("id");
  for (const element of copy.querySelectorAll("[tabindex]")) element.removeAttribute("tabindex");
  copy.querySelectorAll(".controls").forEach((element) => element.remove());
  copy.querySelector(`.values tbody tr:nth-child(${Number(link.dataset.row ?? -2) + 1})`)?.classList.add("printed");
  return isCard ? [...copy.childNodes] : [copy];
};
// Put the card below the link, or above if there is more room.
const place = () => {
  const { left, top, bottom } = owner.getClientRects()[0];
  const { width } = panel.getBoundingClientRect();
  const isBelow = innerHeight - bottom > top;
  panel.style.left = `${Math.max(MARGIN, Math.min(left, document.documentElement.clientWidth - width - MARGIN))}px`;
  panel.style.top = isBelow ? `${bottom + MARGIN}px` : "auto";
  panel.style.bottom = isBelow ? "auto" : `${innerHeight - top + MARGIN}px`;
  panel.style.maxHeight = `${(isBelow ? innerHeight - bottom : top) - 2 * MARGIN}px`;
};
const close = () => {
  clearTimeout(timer);
  if (!owner) return;
  owner.removeAttribute("aria-describedby");
  owner = null;
  isPinned = false;
  panel.hidePopover();
};
const open = (link, pinned) => {
  clearTimeout(timer);
  if (panel.contains(link)) {
    panel.replaceChildren(...copyOf(link));
    panel.scrollTop = 0;
  } else if (link !== owner) {
    close();
    owner = link;
    panel.replaceChildren(...copyOf(link));
    owner.setAttribute("aria-describedby", panel.id);
    panel.showPopover();
    panel.scrollTop = 0;
    place();
  }
  isPinned ||= pinned;
};
const openSoon = (link) => {
  clearTimeout(timer);
  timer = setTimeout(() => open(link, false), HOVER_DELAY);
};
const closeSoon = () => {
  clearTimeout(timer);
  if (!isPinned) timer = setTimeout(close, LEAVE_DELAY);
};

const linkIn = (event) => event.target.closest?.('a[href^="#"]');
const isHover = (event) => event.pointerType === "mouse";
document.addEventListener("pointerover", (event) => {
  if (!isHover(event)) return;
  const link = linkIn(event);
  if (link && !panel.contains(link) && !isPinned) openSoon(link);
  else if (panel.contains(event.target)) clearTimeout(timer);
});
document.addEventListener("pointerout", (event) => {
  if (isHover(event) && (linkIn(event) || panel.contains(event.target))) closeSoon();
});
document.addEventListener("focusin", (event) => {
  const link = linkIn(event);
  if (link && !panel.contains(link) && link.matches(":focus-visible")) open(link, false);
  else if (!panel.contains(event.target)) close();
});
document.addEventListener("click", (event) => {
  const link = linkIn(event);
  const isPlain = !(event.ctrlKey || event.metaKey || event.shiftKey || event.altKey);
  if (link && isPlain) {
    event.preventDefault();
    open(link, true);
    panel.focus();
  } else if (!panel.contains(event.target)) {
    close();
  }
});
document.addEventListener("keydown", (event) => {
  if (event.key !== "Escape" || !owner) return;
  const link = owner;
  const hadFocus = panel.contains(document.activeElement);
  close();
  if (hadFocus) {
    link.focus();
    close(); // the focus has opened it again
  }
});
document.addEventListener("scroll", () => owner && place(), { passive: true });
