// SPDX-License-Identifier: Apache-2.0
// The controls of the report: the theme, sorting, the choice of rays and call, charts, sliders.
"use strict";

// The theme is the system's, until the button changes it.
const themeButton = document.getElementById("theme");
const dark = matchMedia("(prefers-color-scheme: dark)");
const isDark = () => (document.documentElement.dataset.theme ?? (dark.matches ? "dark" : "light")) === "dark";
const showTheme = () => themeButton.setAttribute("aria-pressed", String(isDark()));
themeButton.hidden = false;
themeButton.addEventListener("click", () => {
  document.documentElement.dataset.theme = isDark() ? "light" : "dark";
  showTheme();
});
dark.addEventListener("change", showTheme);
showTheme();

// The headings' buttons sort the table; cells without a value stay last, the means stay below.
function compare(a, b) {
  if (a === "" || b === "") return (a === "") - (b === "");
  return Number(a) - Number(b);
}

function sort(header) {
  const table = header.closest("table");
  const descending = header.getAttribute("aria-sort") === "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  header.setAttribute("aria-sort", descending ? "descending" : "ascending");
  for (const body of table.tBodies) {
    const key = (row) => row.cells[header.cellIndex].dataset.sort;
    const sign = (a, b) => (descending && a !== "" && b !== "" ? -1 : 1);
    const rows = [...body.rows];
    rows.sort((a, b) => sign(key(a), key(b)) * compare(key(a), key(b)));
    body.append(...rows);
    markRepeated(rows);
  }
}

// Of neighbouring rows of one scene only the first shows its name.
function markRepeated(rows) {
  rows.forEach((row, i) => {
    const again = i > 0 && rows[i - 1].cells[0].dataset.sort === row.cells[0].dataset.sort;
    row.cells[0].classList.toggle("again", again);
  });
}

for (const header of document.querySelectorAll(".sortable thead th")) {
  header.querySelector("button").addEventListener("click", () => sort(header));
}

for (const body of document.querySelectorAll(".sortable tbody")) markRepeated([...body.rows]);

// A slider moves the border between its two pictures.
for (const slider of document.querySelectorAll(".compare input")) {
  const move = () => slider.parentElement.style.setProperty("--at", `${slider.value}%`);
  slider.addEventListener("input", move);
  move();
}

// The charts' colours are the page's CSS variables, so they follow the theme, and print, as the page does.
const text = { labelColor: "var(--muted)", titleColor: "var(--ink)", labelFontSize: 12, titleFontSize: 12, titleFontWeight: 500 };
const config = (width) => ({
  background: "transparent",
  font: getComputedStyle(document.body).fontFamily,
  view: { stroke: "transparent" },
  axis: { ...text, gridColor: "var(--line)", domainColor: "var(--line)", tickColor: "var(--line)", labelFlush: false },
  axisY: { labelLimit: width < 560 ? 110 : 220 },
  legend: { ...text, orient: "top", symbolSize: 90, symbolOpacity: 1, columns: Math.max(2, Math.floor(width / 150)), labelLimit: 220, layout: { top: { bounds: "full" } } },
});

const form = document.getElementById("choices");
const choice = () => Object.fromEntries(new FormData(form));

async function drawCharts() {
  const json = (id) => JSON.parse(document.getElementById(id)?.textContent ?? "null");
  const specs = json("specs");
  if (specs === null) return [];
  const datasets = json("datasets");
  const params = Object.entries(choice()).map(([name, value]) => ({ name, value }));
  const draw = async (box) => {
    const own = specs[box.dataset.spec];
    const spec = { ...own, params, datasets: { ...own.datasets, ...datasets } };
    const { view } = await vegaEmbed(box, spec, { renderer: "svg", actions: false, config: config(box.clientWidth) });
    return view;
  };
  return Promise.all([...document.querySelectorAll(".chart")].map(draw));
}

// Charts are filtered by the choice of rays and call; of the tables, the one of the call is shown.
function showTable() {
  const { call } = choice();
  for (const table of document.querySelectorAll(".by-call")) table.hidden = table.dataset.call !== call;
}

async function start() {
  if (form !== null) {
    form.hidden = false;
    showTable();
    const views = await drawCharts();
    form.addEventListener("change", () => {
      const { rays, call } = choice();
      showTable();
      for (const view of views) view.signal("rays", rays).signal("call", call).runAsync();
    });
  }
  document.documentElement.dataset.ready = "";
}

start();
