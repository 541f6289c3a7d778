"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const SVG = "http://www.w3.org/2000/svg";
  const drawing = $("drawing"), slider = $("slider"), play = $("play"), mode = $("mode"), speed = $("speed");
  const groups = [...drawing.querySelectorAll("g.run")].map((run) => [...run.children]);
  const charts = [];
  let run = 0, place = 0, playing = false, before = null;

  const last = () => data.runs[run].t.length - 1;
  /** A column between instants: everything reported is continuous, angles too. null where a number does not exist, as a
   * rate at a dead centre. */
  const between = (list, at) => {
    const k = Math.min(Math.floor(at), list.length - 2), part = at - k;
    if (list.length < 2) return list[0];
    const [here, next] = [list[k], list[k + 1]];
    if (part === 0 || part === 1) return part ? next : here;
    return here === null || next === null ? null : here + part * (next - here);
  };
  /** A number among others as large as `size`, compared with which rounding errors are nothing. */
  const text = (x, size) => (x === null ? "no value" : Math.abs(x) <= 1e-12 * size ? "0" : Number(x.toPrecision(4)).toString());
  const largest = (list) => list.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  /** The largest number among the columns with the unit of this one; of the column alone if it has no unit. */
  const size = (column) => {
    const { unit } = data.columns[column];
    const alike = (_, k) => (unit ? data.columns[k].unit === unit : k === Number(column));
    return largest(data.runs[run].columns.filter(alike).map(largest));
  };

  function show() {
    const { t, tracks } = data.runs[run];
    groups[run].forEach((group, which) => {
      const track = tracks[which];
      const at = (axis) => between(track[axis], track[axis].length === 1 ? 0 : place);
      group.setAttribute("transform", `translate(${at(0)},${at(1)}) rotate(${at(2)})${track.length > 3 ? ` scale(${at(3)})` : ""}`);
    });
    const now = between(t, place);
    $("now").textContent = `${data.along} = ${text(now, largest(t))}${data.time ? " " + data.time : ""}`;
    slider.value = place;
    slider.setAttribute("aria-valuetext", $("now").textContent);
    const driver = (column) => {
      const { name, unit } = data.columns[column];
      const value = between(data.runs[run].columns[column], place);
      return `${name} = ${text(value, size(column))}${unit && value !== null ? " " + unit : ""}`;
    };
    $("drivers").textContent = data.drivers.map(driver).join(" · ");
    charts.forEach((chart) => chart.mark());
  }

  function choose(which) {
    const t = between(data.runs[run].t, place);
    run = which;
    [...drawing.querySelectorAll("g.run")].forEach((g, k) => { g.style.display = k === run ? "" : "none"; });
    drawing.setAttribute("viewBox", `0 0 ${data.runs[run].size.join(" ")}`);
    [...drawing.querySelectorAll("g.scale")].forEach((g, k) => { g.style.display = k === run ? "" : "none"; });
    slider.max = last();
    place = Math.min(seek(t), last());
    $("ended").textContent = data.runs[run].note || "";
    $("ended").hidden = !data.runs[run].note;
    charts.forEach((chart) => chart.draw());
    show();
  }

  /** The place of a time: the instants run one way, but not in equal steps. */
  function seek(time) {
    const { t } = data.runs[run];
    const forward = t[t.length - 1] >= t[0];
    let low = 0, high = t.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (forward === t[middle] <= time) low = middle; else high = middle;
    }
    if (high === low) return low;
    return low + Math.min(1, Math.max(0, (time - t[low]) / (t[high] - t[low])));
  }

  function tick(stamp) {
    if (!playing) return;
    if (before !== null && last() > 0) {
      const { t } = data.runs[run];
      const step = ((stamp - before) / 1000) * Number(speed.value) * ((t[last()] - t[0]) / data.seconds);
      const next = between(t, place) + step;
      const beyond = (next - t[last()]) * Math.sign(t[last()] - t[0]) > 0;
      place = beyond ? 0 : seek(next);
      show();
    }
    before = stamp;
    requestAnimationFrame(tick);
  }

  function toggle(on) {
    playing = on;
    before = null;
    play.textContent = playing ? "❚❚ Pause" : "▶ Play";
    play.setAttribute("aria-pressed", String(playing));
    if (playing) requestAnimationFrame(tick);
  }

  /** Ticks at 1, 2 or 5 times a power of ten. */
  function ticks(low, high, count) {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
    const out = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) out.push(k * step);
    return out;
  }

  class Chart {
    constructor(column) {
      this.box = document.createElement("section");
      this.box.className = "panel chart";
      this.box.innerHTML = '<div class="head"><label>Plot <select></select></label><button type="button">Remove</button></div>';
      this.pick = this.box.querySelector("select");
      data.columns.forEach((info, k) => this.pick.add(new Option(info.name, k)));
      this.pick.value = column;
      this.pick.onchange = () => this.draw();
      this.box.querySelector("button").onclick = () => { this.box.remove(); charts.splice(charts.indexOf(this), 1); };
      this.svg = document.createElementNS(SVG, "svg");
      this.svg.setAttribute("viewBox", "0 0 420 190");
      this.box.append(this.svg);
      const drag = (event) => {
        if (event.type !== "pointerdown" && !(event.buttons & 1)) return;
        const box = this.svg.getBoundingClientRect(), { t } = data.runs[run];
        const x = ((event.clientX - box.left) / box.width) * 420;
        toggle(false);
        place = seek(t[0] + ((x - 56) / 354) * (t[last()] - t[0]));
        show();
      };
      this.svg.addEventListener("pointerdown", drag);
      this.svg.addEventListener("pointermove", drag);
      charts.push(this);
      $("charts").insertBefore(this.box, $("more").parentElement);
      this.draw();
    }
    draw() {
      const info = data.columns[this.pick.value], { t, columns } = data.runs[run];
      const list = columns[this.pick.value];
      const known = list.filter((value) => value !== null);
      let [low, high] = known.length ? [Math.min(...known), Math.max(...known)] : [0, 0];
      this.size = size(this.pick.value);
      // What varies by rounding alone is a straight line.
      const pad = high - low > 1e-9 * this.size ? 0.06 * (high - low) : 0.1 * this.size || 1;
      low -= pad;
      high += pad;
      const x = (time) => 56 + (354 * (time - t[0])) / (t[last()] - t[0] || 1);
      const y = (value) => 160 - (148 * (value - low)) / (high - low);
      Object.assign(this, { x, y, list });
      const parts = [];
      for (const value of ticks(low, high, 5)) {
        parts.push(`<path d="M56,${y(value)}H410" stroke="#e5e7eb"/><text x="51" y="${y(value) + 4}" text-anchor="end">${text(value, high - low)}</text>`);
      }
      for (const time of ticks(Math.min(t[0], t[last()]), Math.max(t[0], t[last()]) || 1, 6)) {
        parts.push(`<path d="M${x(time)},160v4" stroke="#9ca3af"/><text x="${x(time)}" y="175" text-anchor="middle">${text(time, largest(t))}</text>`);
      }
      const unit = info.unit ? ` in ${info.unit}` : "";
      parts.push('<path d="M56,12V160H410" fill="none" stroke="#9ca3af"/>');
      parts.push(`<text x="410" y="187" text-anchor="end">${data.along}${data.time ? " in " + data.time : ""}</text>`);
      const step = (k) => (k > 0 && list[k - 1] !== null ? "L" : "M");
      const point = (value, k) => (value === null ? "" : `${step(k)}${x(t[k]).toFixed(1)},${y(value).toFixed(1)}`);
      parts.push(`<path class="way" d="${list.map(point).join("")}" fill="none" stroke="#0072b2" stroke-width="2" stroke-linejoin="round"/>`);
      parts.push('<path class="now" stroke="#d55e00" stroke-width="1.5"/><circle class="now" r="4" fill="#d55e00"/><text class="value" x="60" y="10"></text>');
      this.svg.innerHTML = parts.join("");
      this.svg.setAttribute("role", "img");
      this.svg.setAttribute("aria-label", `${info.name}${unit} over ${data.along === "t" ? "time" : data.along}`);
      this.label = `${info.name}${unit}`;
      this.mark();
    }
    mark() {
      const { t } = data.runs[run], value = between(this.list, place), x = this.x(between(t, place));
      this.svg.querySelector("path.now").setAttribute("d", `M${x},12V160`);
      const dot = this.svg.querySelector("circle.now");
      dot.setAttribute("visibility", value === null ? "hidden" : "visible");
      dot.setAttribute("cx", x);
      dot.setAttribute("cy", this.y(value ?? 0));
      this.svg.querySelector(".value").textContent = `${this.label}: ${text(value, this.size)}`;
    }
  }

  data.runs.forEach((one, k) => mode.add(new Option(one.name, k)));
  $("modes").hidden = data.runs.length < 2;
  mode.onchange = () => choose(Number(mode.value));
  play.onclick = () => toggle(!playing);
  slider.oninput = () => { toggle(false); place = Number(slider.value); show(); };
  $("names").onchange = () => drawing.classList.toggle("without-names", !$("names").checked);
  $("forces").onchange = () => drawing.classList.toggle("without-forces", !$("forces").checked);
  $("paths").onchange = () => drawing.classList.toggle("without-paths", !$("paths").checked);
  $("more").onclick = () => new Chart(Math.min(charts.length * 3, data.columns.length - 1));
  document.addEventListener("keydown", (event) => {
    const taken = event.target.closest && event.target.closest("button, select, input[type=checkbox]");
    if (event.key === " " && !taken) { event.preventDefault(); toggle(!playing); }
    if (event.key === "Home" && !taken) { place = 0; show(); }
  });
  data.shown.forEach((column) => new Chart(column));
  choose(0);
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches && last() > 0) toggle(true);
  document.documentElement.dataset.ready = "true";
})();
