"use strict";
(() => {
  const filter = document.getElementById("filter");
  const find = document.getElementById("find");
  const shown = document.getElementById("shown");
  const buttons = [...filter.querySelectorAll("button")];
  const entries = [...document.querySelectorAll("article.claim, article.definition")];
  const parts = [...document.querySelectorAll("section.part")];
  const words = new Map(entries.map((entry) => [entry, entry.textContent.toLowerCase()]));
  filter.hidden = false;

  const apply = () => {
    const wanted = new Set(buttons.filter((b) => b.getAttribute("aria-pressed") === "true").map((b) => b.dataset.status));
    const text = find.value.trim().toLowerCase();
    let count = 0;
    for (const entry of entries) {
      const show = (!wanted.size || wanted.has(entry.dataset.status)) && (!text || words.get(entry).includes(text));
      entry.hidden = !show;
      count += show && entry.classList.contains("claim");
    }
    for (const part of parts) part.hidden = !part.querySelector("article:not([hidden])");
    shown.textContent = wanted.size || text ? `${count} shown` : "";
  };
  for (const button of buttons) {
    button.addEventListener("click", () => {
      button.setAttribute("aria-pressed", String(button.getAttribute("aria-pressed") !== "true"));
      apply();
    });
  }
  find.addEventListener("input", apply);

  // A link to an entry that the filter hides shows everything again.
  const reveal = () => {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (target && target.hidden) {
      find.value = "";
      buttons.forEach((b) => b.setAttribute("aria-pressed", "false"));
      apply();
      target.scrollIntoView();
    }
  };
  addEventListener("hashchange", reveal);

  const graph = document.querySelector("svg.graph");
  if (!graph) return;
  const edges = [...graph.querySelectorAll(".edge")];
  const nodes = new Map([...graph.querySelectorAll("a.node")].map((node) => [node.dataset.id, node]));
  const focus = (id) => {
    const near = new Set([id]);
    for (const edge of edges) {
      const on = edge.dataset.from === id || edge.dataset.to === id;
      edge.classList.toggle("on", on);
      if (on) near.add(edge.dataset.from).add(edge.dataset.to);
    }
    for (const [name, node] of nodes) node.classList.toggle("on", near.has(name));
    graph.classList.add("focused");
  };
  const blur = () => graph.classList.remove("focused");
  for (const [id, node] of nodes) {
    node.addEventListener("mouseenter", () => focus(id));
    node.addEventListener("focus", () => focus(id));
    node.addEventListener("mouseleave", blur);
    node.addEventListener("blur", blur);
  }
})();
