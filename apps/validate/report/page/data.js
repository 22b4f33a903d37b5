const report = JSON.parse(document.getElementById("report").textContent);
const stored = JSON.parse(document.getElementById("maps").textContent);
const results = report.results;
const faults = (r) => r.failure ? 0 : r.pixels.unexplained + r.pixels.convention;

