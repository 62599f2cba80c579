"use strict";
(() => {
  const find = document.getElementById("find");
  const hits = document.getElementById("hits");
  const field = document.getElementById("search");
  const MOST = 40;

  // The index of all pages: a script beside the page, or, where everything is on one page, what stands on it.
  let asked;
  const index = () => (asked ??= new Promise((done) => {
    if (window.PTPROOF) return done(window.PTPROOF);
    const articles = [...document.querySelectorAll("article.claim, article.definition")];
    if (document.querySelector("script[src]") === null) {
      const entries = articles.map((a) => [0, a.id, a.querySelector(".id").textContent, a.querySelector(".name").textContent,
        a.dataset.status === "definition" ? "" : a.dataset.status, a.textContent]);
      for (const one of document.querySelectorAll("section.instrument, #figures figure")) {
        const kind = one.className === "instrument" ? "instrument" : "figure";
        entries.push([0, one.id, kind, one.dataset.title ?? one.querySelector("h2").textContent, kind, one.textContent]);
      }
      return done({ pages: [""], entries, sections: [] });
    }
    const script = document.createElement("script");
    script.src = "search.js";
    script.onload = () => done(window.PTPROOF);
    script.onerror = () => done({ pages: [""], entries: [], sections: [] });
    document.head.append(script);
  }));

  const rank = (entry, words) => {
    const [, , id, title, , text] = entry;
    const name = `${id} ${title}`.toLowerCase(), all = `${name} ${text.toLowerCase()}`;
    if (!words.every((word) => all.includes(word))) return -1;
    return words.reduce((sum, word) => sum + (name.includes(word) ? 2 : 0), 0) + (id.toLowerCase() === words.join(" ") ? 9 : 0);
  };
  const SIGNS = { full: "✓", modulo: "✓*", open: "✓?", refuted: "✗", undecided: "?", cited: "§", observed: "◉", "": "≔", instrument: "⇆", figure: "▨" };

  const show = async () => {
    const words = find.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    if (!words.length) { hits.hidden = true; return; }
    const { pages, entries, sections } = await index();
    const found = entries.map((entry) => [rank(entry, words), entry]).filter(([value]) => value >= 0)
      .sort((a, b) => b[0] - a[0]);
    const chapters = sections.filter(([, , title]) => words.every((word) => title.toLowerCase().includes(word)));
    hits.replaceChildren();
    const line = (page, anchor, key, title, id) => {
      const item = document.createElement("li"), link = document.createElement("a");
      link.href = `${pages[page]}#${anchor}`;
      for (const [name, text] of [[`sign g-${key}`, key === null ? "" : SIGNS[key]], ["title", title], ["id", id]]) {
        const part = document.createElement("span");
        part.className = name;
        part.textContent = text;
        link.append(part);
      }
      link.addEventListener("click", () => { hits.hidden = true; });
      item.append(link);
      hits.append(item);
    };
    for (const [page, anchor, title] of chapters.slice(0, 5)) line(page, anchor, null, title, "section");
    for (const [, [page, anchor, id, title, key]] of found.slice(0, MOST)) line(page, anchor, key, title, id);
    const count = document.createElement("li");
    count.className = "found";
    count.textContent = found.length > MOST ? `${MOST} of ${found.length} shown` : `${found.length} found`;
    hits.append(count);
    hits.hidden = false;
  };
  if (find) {
    find.addEventListener("input", show);
    find.addEventListener("focus", show);
    field.addEventListener("submit", async (event) => {
      event.preventDefault();
      await show();
      hits.querySelector("a")?.click();
    });
    field.addEventListener("keydown", (event) => {
      const links = [...hits.querySelectorAll("a")], place = links.indexOf(document.activeElement);
      if (event.key === "Escape") { find.value = ""; hits.hidden = true; find.focus(); }
      if (event.key === "ArrowDown" && place + 1 < links.length) { event.preventDefault(); links[place + 1].focus(); }
      if (event.key === "ArrowUp") { event.preventDefault(); (place > 0 ? links[place - 1] : find).focus(); }
    });
    field.addEventListener("focusout", (event) => { if (event.relatedTarget && !field.contains(event.relatedTarget)) hits.hidden = true; });
    document.addEventListener("click", (event) => { if (!field.contains(event.target)) hits.hidden = true; });
    document.addEventListener("keydown", (event) => {
      if (event.key === "/" && !/^(INPUT|TEXTAREA|SELECT)$/.test(document.activeElement?.tagName)) {
        event.preventDefault();
        find.focus();
      }
    });
  }

  // A link to a claim that does not stand on this page any more, or that was written for the front page.
  const arrive = async () => {
    const anchor = decodeURIComponent(location.hash.slice(1));
    if (!anchor) return;
    const target = document.getElementById(anchor);
    if (target) {
      if (target.tagName === "DETAILS") target.open = true;
      return;
    }
    const { pages, entries, sections } = await index();
    const found = entries.find((entry) => entry[1] === anchor) ?? sections.find((entry) => entry[1] === anchor);
    if (found && pages[found[0]]) location.replace(`${pages[found[0]]}#${anchor}`);
  };
  addEventListener("hashchange", arrive);
  arrive();

  // The arrows of the picture, from the boxes as they stand.
  const picture = document.getElementById("picture");
  if (picture) {
    const canvas = picture.querySelector("svg.arrows");
    const groups = new Map([...picture.querySelectorAll(".group")].map((group) => [group.id, group]));
    const draw = () => {
      const frame = picture.getBoundingClientRect();
      canvas.setAttribute("viewBox", `0 0 ${frame.width} ${frame.height}`);
      canvas.setAttribute("width", frame.width);
      canvas.setAttribute("height", frame.height);
      canvas.replaceChildren();
      for (const group of groups.values()) {
        for (const other of group.dataset.uses.split(" ").filter(Boolean)) {
          const from = groups.get(other).getBoundingClientRect(), to = group.getBoundingClientRect();
          const x1 = from.left + from.width / 2 - frame.left, y1 = from.bottom - frame.top;
          const x2 = to.left + to.width / 2 - frame.left, y2 = to.top - frame.top - 3;
          const bend = Math.max((y2 - y1) / 2, 12);
          const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
          path.setAttribute("d", `M${x1} ${y1}C${x1} ${y1 + bend} ${x2} ${y2 - bend} ${x2} ${y2}`);
          path.dataset.from = other;
          path.dataset.to = group.id;
          canvas.append(path);
        }
      }
    };
    const near = (id) => {
      for (const path of canvas.children) path.classList.toggle("on", path.dataset.from === id || path.dataset.to === id);
    };
    for (const [id, group] of groups) {
      group.addEventListener("mouseenter", () => near(id));
      group.addEventListener("mouseleave", () => near(""));
      group.addEventListener("focusin", () => near(id));
    }
    new ResizeObserver(draw).observe(picture);
    draw();

    // The name and the formula of a claim, beside its mark: from its entry on this page, or from a script beside it.
    let loaded;
    const formulas = () => (loaded ??= new Promise((done) => {
      const script = document.createElement("script");
      script.src = "formulas.js";
      script.onload = () => done(window.PTPROOF_FORMULAS);
      script.onerror = () => done({});
      document.head.append(script);
    }));
    let over = null;
    const tell = async (mark, link) => {
      over = mark;
      const anchor = decodeURIComponent(link.hash.slice(1)), here = document.getElementById(anchor);
      const found = here ? here.querySelector(".formula, .words")?.outerHTML : (await formulas())[anchor];
      if (over !== mark || (!found && mark === link)) return;
      const name = Object.assign(document.createElement("p"), { textContent: link.textContent });
      tip.show((mark === link ? "" : name.outerHTML) + (found ?? ""), mark.getBoundingClientRect());
    };
    const hush = () => { over = null; tip.hide(); };
    addEventListener("keydown", (event) => { if (event.key === "Escape") hush(); });
    for (const group of groups.values()) {
      const links = [...group.querySelectorAll(".inside li a")];
      for (const [place, mark] of [...links, ...group.querySelectorAll(".strip .m")].entries()) {
        const link = links[place % links.length];
        mark.addEventListener("mouseenter", () => tell(mark, link));
        mark.addEventListener("focus", () => tell(mark, link));
        mark.addEventListener("mouseleave", hush);
        mark.addEventListener("blur", hush);
      }
    }
  }

  // On paper a wide formula is set smaller, since nothing scrolls there.
  addEventListener("beforeprint", () => {
    const wide = [...document.querySelectorAll("math")].map((math) => [math, math.getBoundingClientRect().width]);
    for (const [math, width] of wide) math.style.setProperty("--em", Math.max(1, width / parseFloat(getComputedStyle(math).fontSize)));
  });

  // What is wider than its place can be reached, and moved, by the keyboard; so can what is not set yet, being far away.
  const scrolls = new ResizeObserver((seen) => {
    for (const { target } of seen) {
      if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
      else if (target !== document.activeElement && !target.matches("article .formula")) target.removeAttribute("tabindex");
    }
  });
  for (const item of document.querySelectorAll(".formula, .value, .prose, .canvas, .witness dd, table, pre")) {
    item.tabIndex = 0;
    scrolls.observe(item);
  }

  // Cards far away are set after the rest, a few at a time: the page is there at once, and soon after all of it.
  const later = [...document.querySelectorAll(".claim, .definition, .erratum")];
  const soon = window.requestIdleCallback ?? setTimeout;
  const set = () => {
    for (const card of later.splice(0, 4)) card.style.contentVisibility = "visible";
    if (later.length) soon(set);
  };
  addEventListener("load", () => soon(set));

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
