// The arm in three dimensions: a canvas, a slider for each variable and parameter, the pose live.
// ARM is the table as data, written by symdh; nothing is fetched.
"use strict";
(function () {
  const canvas = document.getElementById("arm");
  const panel = document.getElementById("controls");
  if (!canvas || !canvas.getContext) return;
  const pen = canvas.getContext("2d");
  const values = {};
  for (const slider of ARM.sliders) values[slider.name] = slider.value;
  const camera = { turn: 0.9, tilt: 0.4, zoom: 1, x: 0, y: 0 };
  const show = { frames: true, dimensions: false };

  // ---- kinematics: elementary motions as 4x4 matrices, row by row ----

  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

  function product(a, b) {
    const c = new Array(16);
    for (let i = 0; i < 4; i++)
      for (let j = 0; j < 4; j++) {
        let sum = 0;
        for (let k = 0; k < 4; k++) sum += a[4 * i + k] * b[4 * k + j];
        c[4 * i + j] = sum;
      }
    return c;
  }

  function motion(kind, axis, amount) {
    const m = identity.slice();
    if (kind === "T") {
      m[4 * axis + 3] = amount;
      return m;
    }
    const i = (axis + 1) % 3, j = (axis + 2) % 3;
    const c = Math.cos(amount), s = Math.sin(amount);
    m[5 * i] = c; m[4 * i + j] = -s;
    m[4 * j + i] = s; m[5 * j] = c;
    return m;
  }

  // Every frame of the chain with the bends between it and the one before, so that links are
  // drawn along d and a and not straight across.
  function chain() {
    let pose = identity;
    const frames = [];
    for (const segment of ARM.segments) {
      const bends = [pose];
      for (const [kind, axis, amount] of segment.motions) {
        pose = product(pose, motion(kind, axis, amount(values)));
        bends.push(pose);
      }
      frames.push({ segment, bends, pose });
    }
    return frames;
  }

  // ---- projection ----

  const origin = (m) => [m[3], m[7], m[11]];
  const along = (m, axis, length) => [
    m[3] + length * m[axis], m[7] + length * m[4 + axis], m[11] + length * m[8 + axis],
  ];

  let scale = 1, centre = [0, 0, 0], reach = 1;

  function project([x, y, z]) {
    const a = x - centre[0], b = y - centre[1], c = z - centre[2];
    const st = Math.sin(camera.turn), ct = Math.cos(camera.turn);
    const sl = Math.sin(camera.tilt), cl = Math.cos(camera.tilt);
    const right = -st * a + ct * b, depth = ct * a + st * b;
    const up = c * cl - depth * sl;
    const k = scale * camera.zoom;
    return [canvas.clientWidth / 2 + camera.x + k * right, canvas.clientHeight / 2 + camera.y - k * up];
  }

  // The largest extent of the arm over its sliders' starting values fixes the scale once, so that
  // the picture does not breathe while a joint moves.
  function fit() {
    const points = chain().flatMap((frame) => frame.bends.map(origin));
    points.push([0, 0, 0]);
    let lengths = 0;
    for (const segment of ARM.segments)
      for (const [kind, , amount] of segment.motions)
        if (kind === "T") lengths += Math.abs(amount(values));
    const low = [0, 1, 2].map((i) => Math.min(...points.map((p) => p[i])));
    const high = [0, 1, 2].map((i) => Math.max(...points.map((p) => p[i])));
    centre = low.map((value, i) => (value + high[i]) / 2);
    const far = Math.max(...points.map((p) => Math.hypot(...p.map((v, i) => v - centre[i]))));
    reach = Math.max(far, 0.4 * lengths);
    if (reach < 1e-9) reach = 1;
  }

  // ---- drawing ----

  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  function line(points, colour, width, dash) {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash || []);
    pen.beginPath();
    points.map(project).forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.stroke();
    pen.setLineDash([]);
  }

  function label(text, at, colour) {
    const [x, y] = project(at);
    pen.font = "13px system-ui, sans-serif";
    pen.lineWidth = 3;
    pen.strokeStyle = style("--page");
    pen.strokeText(text, x + 5, y - 5);
    pen.fillStyle = colour;
    pen.fillText(text, x + 5, y - 5);
  }

  function ring(pose, radius, half, colour) {
    const circle = (height) => {
      const points = [];
      for (let k = 0; k <= 24; k++) {
        const angle = (k * Math.PI) / 12;
        const base = along(pose, 2, height);
        points.push([0, 1, 2].map((r) =>
          base[r] + radius * (Math.cos(angle) * pose[4 * r] + Math.sin(angle) * pose[4 * r + 1])));
      }
      return points;
    };
    const top = circle(half), bottom = circle(-half);
    pen.fillStyle = style("--joint");
    for (const face of [bottom, top]) {
      pen.beginPath();
      face.map(project).forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
      pen.fill();
    }
    line(top, colour, 1.5);
    line(bottom, colour, 1.5);
    for (const k of [0, 6, 12, 18]) line([top[k], bottom[k]], colour, 1.5);
  }

  function box(pose, side, half, colour) {
    const corner = (i, j, k) => [0, 1, 2].map((r) =>
      pose[4 * r + 3] + side * (i * pose[4 * r] + j * pose[4 * r + 1]) + half * k * pose[4 * r + 2]);
    for (const k of [-1, 1])
      line([corner(-1, -1, k), corner(1, -1, k), corner(1, 1, k), corner(-1, 1, k), corner(-1, -1, k)], colour, 1.5);
    for (const [i, j] of [[-1, -1], [1, -1], [1, 1], [-1, 1]])
      line([corner(i, j, -1), corner(i, j, 1)], colour, 1.5);
  }

  function triad(pose, name) {
    const length = 0.13 * reach;
    ["--x", "--y", "--z"].forEach((colour, axis) =>
      line([origin(pose), along(pose, axis, length)], style(colour), 2));
    label(name, origin(pose), style("--ink"));
  }

  function arc(pose, axis, amount, text) {
    if (Math.abs(amount) < 1e-9) return;
    const radius = 0.1 * reach, points = [];
    const first = (axis + 1) % 3, second = (axis + 2) % 3;
    // Angles are measured from x about z, and from z about x.
    const from = axis === 2 ? 0 : Math.PI / 2;
    for (let k = 0; k <= 16; k++) {
      const angle = from + (amount * k) / 16;
      points.push([0, 1, 2].map((r) => pose[4 * r + 3] + radius *
        (Math.cos(angle) * pose[4 * r + first] + Math.sin(angle) * pose[4 * r + second])));
    }
    line(points, style("--mark"), 1.5);
    label(text, points[10], style("--mark"));
  }

  function dimension(frame) {
    frame.segment.motions.forEach(([kind, axis, amount, text], k) => {
      const start = frame.bends[k], value = amount(values);
      if (kind === "R") arc(start, axis, value, text);
      else if (Math.abs(value) > 1e-9) {
        const points = [origin(start), origin(frame.bends[k + 1])];
        line(points, style("--mark"), 1.5, [5, 4]);
        label(text, points[0].map((v, i) => (v + points[1][i]) / 2), style("--mark"));
      }
    });
  }

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== width * ratio || canvas.height !== height * ratio) {
      canvas.width = width * ratio;
      canvas.height = height * ratio;
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.lineCap = pen.lineJoin = "round";
    scale = (0.42 * Math.min(width, height)) / reach;
    const frames = chain(), floor = Math.min(0, centre[2]);
    for (let k = -4; k <= 4; k++) {
      const at = (k * reach) / 4;
      line([[at, -reach, floor], [at, reach, floor]], style("--grid"), 1);
      line([[-reach, at, floor], [reach, at, floor]], style("--grid"), 1);
    }
    for (const frame of frames) line(frame.bends.map(origin), style("--link"), 7);
    for (const frame of frames) {
      const at = frame.bends[frame.segment.joint];
      if (frame.segment.type === "revolute") ring(at, 0.07 * reach, 0.09 * reach, style("--ink"));
      if (frame.segment.type === "prismatic") box(at, 0.065 * reach, 0.09 * reach, style("--ink"));
    }
    if (show.frames) {
      triad(identity, "{" + ARM.start + "}");
      for (const frame of frames) triad(frame.pose, "{" + frame.segment.frame + "}");
    }
    if (show.dimensions) frames.forEach(dimension);
    report(frames.length ? frames[frames.length - 1].pose : identity);
  }

  function report(pose) {
    const cells = document.querySelectorAll("#pose td");
    for (let k = 0; k < 16; k++) {
      const value = Math.abs(pose[k]) < 5e-13 ? 0 : pose[k];
      cells[k].textContent = value.toFixed(4);
    }
    canvas.dataset.pose = JSON.stringify(pose);
  }

  // ---- controls ----

  function slider(entry) {
    const row = document.createElement("div"), input = document.createElement("input");
    const text = document.createElement("label"), shown = document.createElement("output");
    row.className = "slider";
    input.type = "range";
    input.id = "slider-" + entry.name;
    input.min = entry.low; input.max = entry.high; input.step = (entry.high - entry.low) / 720;
    input.value = entry.value;
    text.htmlFor = shown.htmlFor = input.id;
    text.textContent = entry.label;
    const tell = () => {
      values[entry.name] = Number(input.value);
      const number = entry.degrees ? (values[entry.name] * 180) / Math.PI : values[entry.name];
      const text = number.toFixed(entry.degrees ? 1 : 3);
      shown.textContent = (Number(text) === 0 ? text.replace("-", "") : text) + entry.unit;
      input.setAttribute("aria-valuetext", shown.textContent);
    };
    // The step must not move the value that the table gives.
    const exact = entry.value;
    tell();
    values[entry.name] = exact;
    input.addEventListener("input", () => { tell(); draw(); });
    row.append(text, input, shown);
    return row;
  }

  function toggle(name, text) {
    const box = document.createElement("label"), input = document.createElement("input");
    input.type = "checkbox";
    input.checked = show[name];
    input.addEventListener("change", () => { show[name] = input.checked; draw(); });
    box.append(input, " " + text);
    return box;
  }

  for (const entry of ARM.sliders) panel.append(slider(entry));
  const switches = document.createElement("div");
  switches.className = "switches";
  switches.append(toggle("frames", "frames"), toggle("dimensions", "a, α, d, θ"));
  panel.append(switches);

  const fingers = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    fingers.set(event.pointerId, event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    if (fingers.size === 1) {
      if (event.shiftKey) {
        camera.x += event.clientX - before.clientX;
        camera.y += event.clientY - before.clientY;
      } else orbit(event.clientX - before.clientX, event.clientY - before.clientY);
    } else if (fingers.size === 2) {
      const [other] = [...fingers.values()].filter((f) => f.pointerId !== event.pointerId);
      const span = (e) => Math.hypot(e.clientX - other.clientX, e.clientY - other.clientY);
      camera.zoom *= span(event) / Math.max(1, span(before));
    }
    fingers.set(event.pointerId, event);
    draw();
  });
  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom *= Math.exp(-event.deltaY / 500);
    draw();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const steps = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] };
    if (steps[event.key]) orbit(...steps[event.key]);
    else if (event.key === "+" || event.key === "=") camera.zoom *= 1.1;
    else if (event.key === "-") camera.zoom /= 1.1;
    else if (event.key === "0") Object.assign(camera, { turn: 0.9, tilt: 0.4, zoom: 1, x: 0, y: 0 });
    else return;
    event.preventDefault();
    draw();
  });

  function orbit(right, down) {
    camera.turn -= right / 150;
    camera.tilt = Math.max(-1.55, Math.min(1.55, camera.tilt + down / 150));
  }

  window.addEventListener("resize", draw);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  fit();
  draw();
})();
