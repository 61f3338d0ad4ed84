
"use strict";
const body = document.querySelector("tbody");
const heads = [...document.querySelectorAll("thead th")];
heads.forEach((head, column) => {
  if (head.textContent === "own picture" || head.textContent === "differences") return;
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = head.textContent;
  head.replaceChildren(button);
  const isNumber = head.classList.contains("number");
  button.addEventListener("click", () => {
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const key = (row) => {
      const cell = row.cells[column];
      if (!isNumber) return cell.textContent;
      const number = cell.dataset.key === "inf" ? Infinity : parseFloat(cell.dataset.key);
      return number;
    };
    const rows = [...body.rows].map((row) => [key(row), row]);
    rows.sort(([a], [b]) => {
      if (!isNumber) return (down ? -1 : 1) * a.localeCompare(b, undefined, { numeric: true });
      // Rows without the number stay at the end.
      if (Number.isNaN(a) || Number.isNaN(b)) return Number.isNaN(a) - Number.isNaN(b);
      return a === b ? 0 : (down ? -1 : 1) * (a < b ? -1 : 1);
    });
    body.append(...rows.map(([, row]) => row));
  });
});
