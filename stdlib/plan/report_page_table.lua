--- The script of a report page that sorts the table, selects the grasp for the view, and draws the first picture.
return [==[
const body = document.querySelector("tbody"), caption = view.querySelector(".shown");

function select(row) {
  body.querySelectorAll("[aria-selected=true]").forEach(other => other.removeAttribute("aria-selected"));
  row.setAttribute("aria-selected", "true");
  const number = Number(row.dataset.grasp);
  caption.textContent = "Grasp " + number;
  show(number - 1);
}
body.addEventListener("click", e => { const row = e.target.closest("tr"); if (row) select(row); });
document.addEventListener("keydown", e => {
  const row = body.querySelector("[aria-selected=true]");
  const next = !row ? null : e.key === "ArrowDown" ? row.nextElementSibling : e.key === "ArrowUp" ? row.previousElementSibling : null;
  if (!next) return;
  e.preventDefault();
  select(next);
  next.scrollIntoView({block: "nearest"});
});

// a column is sorted by decreasing values, the numbers of the grasps increase; a second click reverses the order
document.querySelectorAll("th[data-column]").forEach(head => head.addEventListener("click", () => {
  const column = Number(head.dataset.column), was = head.getAttribute("aria-sort");
  const up = was ? was === "descending" : column === 0;
  document.querySelectorAll("th[aria-sort]").forEach(other => other.removeAttribute("aria-sort"));
  head.setAttribute("aria-sort", up ? "ascending" : "descending");
  const value = row => { const text = row.querySelectorAll("td[data-value]")[column].dataset.value; return text === "" ? -Infinity : Number(text); };
  [...body.rows].map(row => [value(row), row])
    .sort((a, b) => (a[0] === b[0] ? 0 : a[0] < b[0] ? -1 : 1) * (up ? 1 : -1))
    .forEach(([, row]) => body.appendChild(row));
}));

if (body.rows.length > 0) {
  select(body.rows[0]);
  resize();
  if (renderer) {
    // number of sampled pixels that are not background
    const gl = renderer.getContext(), size = [gl.drawingBufferWidth, gl.drawingBufferHeight], pixel = new Uint8Array(4);
    let covered = 0;
    for (let x = 1; x < 24; ++x) for (let y = 1; y < 24; ++y) {
      gl.readPixels(size[0] * x / 24 | 0, size[1] * y / 24 | 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      covered += pixel[3] > 0;
    }
    document.documentElement.dataset.drawn = covered;
  }
}
]==]
