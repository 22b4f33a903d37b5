/// The table of scenes × renderers, with a column for each variant below its renderer, and sums.

/// Values of a field, each once, in the order in which they come.
const distinct = (list, field) => [...new Set(list.map(field))];

/// `entries` have scene, renderer and variant; `shown(entry)` tells which of them are in the table.
/// `cellOf(k)` is { text, tone, says } of entry k; its cell leads somewhere if `leads(k)`, by `choose(k)`, and is
/// marked if `isChosen(k)`. `sums` are { name, word, of: entry → number, tone }, word being the singular of the name,
/// which `meanings` explains; they are added up for each scene, column and renderer, and over all.
function overviewTable(table, entries, { cellOf, sums, shown, leads = () => true, choose, isChosen, about }) {
  const visible = entries.map((entry, k) => ({ entry, k })).filter(({ entry }) => shown(entry));
  // In the order of all entries, whatever is shown of them.
  const among = (field) => distinct(entries, field).filter((value) => visible.some((v) => field(v.entry) == value));
  const scenes = among((e) => e.scene), columns = [];
  for (const renderer of among((e) => e.renderer))
    for (const variant of distinct(entries.filter((e) => e.renderer == renderer), (e) => e.variant))
      if (visible.some((v) => v.entry.renderer == renderer && v.entry.variant == variant)) columns.push({ renderer, variant, opens: columns.at(-1)?.renderer != renderer });
  // Whether there is anything to add up does not depend on the filter: sums stay where they are.
  const manyColumns = distinct(entries, label).length > 1, manyScenes = distinct(entries, (e) => e.scene).length > 1;
  const total = (sum, list) => list.reduce((n, v) => n + sum.of(v.entry), 0);
  const sumCell = (sum, list, attributes = {}) => {
    const n = total(sum, list);
    return element("td", n, { ...attributes, class: "sum " + (n ? sum.tone : "dim") + (attributes.class ? " " + attributes.class : "") });
  };
  const isIn = (column) => (v) => v.entry.renderer == column.renderer && v.entry.variant == column.variant;
  const opensIf = (first) => first ? { class: "opens" } : {};

  table.replaceChildren(element("caption", about, { class: "hidden-visually" }));
  if (!visible.length) { table.createTBody().append(element("tr")); table.tBodies[0].rows[0].append(element("td", "Nothing matches the filter.", { class: "text" })); return; }
  const head = table.createTHead(), groups = row(head, [heading("scene", { rowspan: 2, class: "corner" })], "th"), variants = row(head, []);
  const groupHeading = (text, colspan) => heading(element("span", text, { class: "kept" }), { scope: "colgroup", class: "opens", colspan });
  const renderers = distinct(columns, (c) => c.renderer), width = (renderer) => columns.filter((c) => c.renderer == renderer).length;
  for (const renderer of renderers) groups.append(groupHeading(renderer, width(renderer)));
  for (const column of columns) variants.append(heading(column.variant || column.renderer, opensIf(column.opens)));
  if (manyColumns && sums.length) {
    groups.append(groupHeading("all", sums.length));
    sums.forEach((sum, s) => variants.append(heading(term(sum.word, sum.name), opensIf(s == 0))));
  }

  const body = table.createTBody();
  for (const scene of scenes) {
    const ofScene = visible.filter((v) => v.entry.scene == scene), line = row(body, [heading(scene, { scope: "row" })]);
    for (const column of columns) {
      const cell = element("td", undefined, opensIf(column.opens)), v = ofScene.find(isIn(column));
      line.append(cell);
      if (!v) continue;
      const { text, tone, says } = cellOf(v.k), name = titleOf(v.entry) + ": " + says;
      cell.classList.add(tone);
      if (!leads(v.k)) { cell.append(element("span", text, { title: name })); continue; }
      const button = element("button", text, { type: "button", title: name, "aria-label": name, "data-case": v.k, tabindex: -1, ...(isChosen ? { "aria-pressed": isChosen(v.k) } : {}) });
      button.addEventListener("click", () => choose(v.k));
      cell.append(button);
    }
    if (manyColumns) sums.forEach((sum, s) => line.append(sumCell(sum, ofScene, opensIf(s == 0))));
  }

  if (manyScenes) {
    const foot = table.createTFoot();
    sums.forEach((sum) => {
      const line = row(foot, [heading(term(sum.word, sum.name), { scope: "row" })]);
      for (const column of columns) line.append(sumCell(sum, visible.filter(isIn(column)), opensIf(column.opens)));
      if (manyColumns) sums.forEach((other, s) => line.append(other == sum ? sumCell(sum, visible, opensIf(s == 0)) : element("td", "", opensIf(s == 0))));
    });
  }
  if (manyColumns && sums.length) {
    const line = row(table.tFoot ?? table.createTFoot(), [heading("by renderer", { scope: "row" })]);
    for (const renderer of renderers) {
      const own = visible.filter((v) => v.entry.renderer == renderer), some = sums.filter((sum) => total(sum, own));
      const text = (some.length ? some : sums.slice(0, 1)).map((sum) => counted(total(sum, own), sum.word, sum.name)).join(", ");
      const cell = element("td", undefined, { class: "opens of-renderer", "data-renderer": renderer, colspan: width(renderer) });
      cell.append(element("span", text, { class: "kept" }));
      line.append(cell);
    }
    line.append(element("td", counted(visible.length, "result"), { class: "opens", colspan: sums.length }));
  }
  // One stop of the tabulator key; arrows go on from there.
  (table.querySelector("button[aria-pressed=true]") ?? table.querySelector("button"))?.setAttribute("tabindex", 0);
  keepClear(table);
}

/// Whatever is scrolled into view is not left below the headings that stay.
function keepClear(table) {
  const place = table.closest(".wide"), corner = table.querySelector(".corner");
  if (!corner) return;
  place.style.setProperty("--first", corner.offsetWidth + "px");
  place.style.scrollPadding = table.tHead.offsetHeight + "px 0 0 " + corner.offsetWidth + "px";
}

/// Tables fade at the right where they go on, so that it shows that they scroll.
function fadeWhereMore() {
  for (const place of document.querySelectorAll(".wide")) {
    const update = () => place.classList.toggle("more", place.scrollLeft + place.clientWidth < place.scrollWidth - 1);
    place.addEventListener("scroll", update);
    const sizes = new ResizeObserver(update);
    for (const each of [place, ...place.children]) sizes.observe(each);
  }
}

const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
/// Arrow keys lead from cell to cell, over those that are empty.
function walkByArrows(table) {
  table.addEventListener("keydown", (event) => {
    const button = event.target.closest("button"), step = steps[event.key];
    if (!button || !step) return;
    event.preventDefault();
    const rows = [...table.tBodies[0].rows];
    let y = rows.indexOf(button.closest("tr")), x = button.closest("td").cellIndex, next;
    do { y += step[0]; x += step[1]; next = rows[y]?.cells[x]; } while (next && !next.querySelector("button"));
    if (!next) return;
    next.firstChild.focus();
  });
  table.addEventListener("focusin", (event) => {
    const button = event.target.closest("button");
    if (button) for (const other of table.querySelectorAll("button")) other.tabIndex = other == button ? 0 : -1;
  });
}

/// A filter by words, all of which occur in the names of an entry, and one by what is not as it should be.
/// Calls `draw(shown)` now and whenever it changes.
function filterBy(entries, isOpen, textOfOpen, draw) {
  const form = byId("filter"), words = element("input", undefined, { type: "search", id: "filter-words", placeholder: "such as: sphere unorm24", autocomplete: "off" });
  const open = element("input", undefined, { type: "checkbox", id: "filter-open" }), said = element("output", undefined, { id: "filter-said", for: "filter-words filter-open" });
  const openLabel = element("label", undefined, { for: "filter-open" });
  openLabel.append(open, " " + textOfOpen);
  form.append(element("label", "Scenes, renderers, variants", { for: "filter-words" }), words, openLabel, said);
  form.hidden = entries.length < 2;
  const apply = () => {
    const wanted = words.value.toLowerCase().split(/\s+/).filter((w) => w);
    const shown = (e) => (!open.checked || isOpen(e)) && wanted.every((w) => (e.scene + " " + label(e)).toLowerCase().includes(w));
    said.textContent = entries.filter(shown).length + " of " + counted(entries.length, "result");
    draw(shown);
  };
  form.addEventListener("input", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  apply();
}
