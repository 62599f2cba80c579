"use strict";
// A box beside what is pointed at or has the focus.
const tip = (() => {
  const box = document.createElement("div");
  box.className = "note";
  box.id = "note";
  box.setAttribute("role", "tooltip");
  box.hidden = true;
  document.body.append(box);
  return {
    show(content, place) {
      box.innerHTML = content;
      box.hidden = false;
      box.style.left = `${Math.max(8, Math.min(place.left, innerWidth - box.offsetWidth - 8))}px`;
      const below = place.bottom + 6;
      box.style.top = `${below + box.offsetHeight > innerHeight ? Math.max(8, place.top - box.offsetHeight - 6) : below}px`;
    },
    hide() { box.hidden = true; },
  };
})();

// What a letter of a formula stands for, with its unit: pointed at, tapped, or all of a formula that has the focus.
(() => {
  const PLACED = new Set(["msub", "msubsup", "munder", "mover", "munderover", "mmultiscripts"]);
  const LONGEST = 9, STAR = /^[*∗′⋆]/;
  let asked;
  const table = () => (asked ??= new Promise((done) => {
    if (window.PTPROOF_LETTERS) return done(window.PTPROOF_LETTERS);
    const script = document.createElement("script");
    script.src = "letters.js";
    script.onload = () => done(window.PTPROOF_LETTERS ?? {});
    script.onerror = () => done({});
    document.head.append(script);
  }));

  // The same spelling of a formula as ptproof.report.letters.spelled.
  const spelled = (node) => {
    if (!node.childElementCount) return node.textContent.trim();
    const inside = [...node.children].map(spelled);
    return /^(math|mrow|mstyle|mpadded)$/.test(node.localName) ? inside.join("") : `${node.localName}(${inside.join(",")})`;
  };
  const powerless = (node) => {
    if (node.localName !== "msubsup" || STAR.test(spelled(node.lastElementChild))) return "";
    return `msub(${[...node.children].slice(0, 2).map(spelled).join(",")})`;
  };
  // An exponent leaves a letter what it is, unless it is a star; an index or an accent makes another letter of it.
  const changed = (node, within) => PLACED.has(within.localName)
    || (within.localName === "msup" && node === within.firstElementChild && STAR.test(spelled(within.lastElementChild)));
  const differential = (leaf) => {
    if (leaf.textContent.trim() !== "d") return false;
    if (/∫/.test(leaf.closest("math").textContent)) return true;
    const fraction = leaf.closest("mfrac");
    return Boolean(fraction) && [...fraction.children].every((part) => part.textContent.trim().startsWith("d"));
  };
  const unlike = (leaf) => {
    const said = leaf.closest("[data-unlike]");
    return new Set(said ? said.dataset.unlike.split(" ") : []);
  };
  const find = (leaf, letters) => {
    if (!leaf.closest("article") || differential(leaf)) return null;
    const except = unlike(leaf);
    let found = null;
    for (let node = leaf; node && node.localName !== "math"; node = node.parentElement) {
      const within = node.parentElement, inside = [...within.children], place = inside.indexOf(node);
      for (const own of [spelled(node), powerless(node)]) if (own in letters && !except.has(own)) found = own;
      if (/^(math|mrow|mtd|msqrt|mstyle)$/.test(within.localName)) {
        for (let first = Math.max(0, place - LONGEST); first <= place; first++) {
          let key = "";
          for (let last = first; last < Math.min(inside.length, first + LONGEST); last++) {
            key += spelled(inside[last]);
            if (last > first && last >= place && key in letters && !except.has(key)) found = key;
          }
        }
      }
      if (changed(node, within)) found = null;
    }
    return found;
  };
  const line = ([glyph, ...meanings]) => {
    const words = document.createElement("span");
    words.textContent = `: ${meanings.join("; or ")}`;
    return `<p class="letter">${glyph}${words.outerHTML}</p>`;
  };
  const leaf = (event) => {
    const node = event.target instanceof Element ? event.target : null;
    return node?.closest("math") && !node.childElementCount ? node : null;
  };
  let over = null;
  const tell = async (node) => {
    over = node;
    const letters = await table(), key = node && find(node, letters);
    if (over !== node) return;
    if (key) tip.show(line(letters[key]), node.getBoundingClientRect());
    else tip.hide();
  };
  document.addEventListener("pointerover", (event) => {
    if (event.pointerType !== "touch" && (leaf(event) || over)) tell(leaf(event));
  });
  document.addEventListener("click", (event) => { if (leaf(event) || over) tell(leaf(event)); });
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") { over = null; tip.hide(); } });
  for (const formula of document.querySelectorAll("article .formula")) {
    formula.tabIndex = 0;
    formula.setAttribute("role", "group");
    formula.setAttribute("aria-label", "formula");
    formula.addEventListener("focus", async () => {
      if (!formula.matches(":focus-visible")) return;
      const letters = await table(), met = new Set();
      for (const node of formula.querySelectorAll("math *")) if (!node.childElementCount) met.add(find(node, letters));
      met.delete(null);
      if (!met.size || document.activeElement !== formula) return;
      tip.show([...met].map((key) => line(letters[key])).join(""), formula.getBoundingClientRect());
      formula.setAttribute("aria-describedby", "note");
    });
    formula.addEventListener("blur", () => { formula.removeAttribute("aria-describedby"); tip.hide(); });
  }
})();
