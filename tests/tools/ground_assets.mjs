// Makes the two meshes that a thesis on the atmosphere was measured with (Iniesta and Pérez 2015), by their numbers of
// triangles: mountains of 97,650 and a town of 11,820, as OBJ with MTL, textures and normal maps.
//
//     node tests/tools/ground_assets.mjs FOLDER
//
// FOLDER then holds `mountains/` and `town/`, as a store of assets takes them in `meshes/`. The same every time.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";

// 225 x 217 cells of two triangles.
const MOUNTAINS = { columns: 225, rows: 217, cell_m: 90, height_m: 2200 };
// 10 x 10 cells of street, 400 gabled houses of 14 triangles and 602 blocks of 10.
const TOWN = { streets: 10, houses: 400, blocks: 602, side_m: 1600 };

/** Numbers from 0 to 1 (mulberry32). */
function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Smooth noise over the plane, -1 to 1, that repeats after `period` if there is one. */
function noise(seed, period) {
  const lattice = (x, y) => {
    const [i, j] = period ? [x, y].map((n) => ((n % period) + period) % period) : [x, y];
    const mixed = Math.imul(Math.imul(i, 374761393) + Math.imul(j, 668265263) + seed, 1274126177);
    return (((mixed ^ (mixed >>> 15)) >>> 0) / 2 ** 32) * 2 - 1;
  };
  const ease = (t) => t * t * (3 - 2 * t);
  return (x, y) => {
    const [i, j] = [Math.floor(x), Math.floor(y)];
    const [u, v] = [ease(x - i), ease(y - j)];
    const row = (k) => lattice(i, k) * (1 - u) + lattice(i + 1, k) * u;
    return row(j) * (1 - v) + row(j + 1) * v;
  };
}

function octaves(seed, count, shape, period) {
  const layers = Array.from({ length: count }, (_, i) => noise(seed + i, period && period * 2 ** i));
  return (x, y) => layers.reduce((sum, layer, i) => sum + shape(layer(x * 2 ** i, y * 2 ** i)) / 2 ** i, 0);
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** An RGB picture whose pixels `colour(x, y)` gives, 0 to 255. */
function png(side, colour) {
  const lines = Buffer.alloc(side * (side * 3 + 1));
  for (let y = 0; y < side; y++) {
    for (let x = 0; x < side; x++) {
      colour(x, y).forEach((value, i) => {
        lines[y * (side * 3 + 1) + 1 + x * 3 + i] = Math.max(0, Math.min(255, Math.round(value)));
      });
    }
  }
  const chunk = (kind, data) => {
    const body = Buffer.concat([Buffer.from(kind, "latin1"), data]);
    const ends = [Buffer.alloc(4), Buffer.alloc(4)];
    ends[0].writeUInt32BE(data.length);
    ends[1].writeUInt32BE(crc32(body));
    return Buffer.concat([ends[0], body, ends[1]]);
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(side, 0);
  header.writeUInt32BE(side, 4);
  header.set([8, 2, 0, 0, 0], 8);
  const chunks = [chunk("IHDR", header), chunk("IDAT", deflateSync(lines)), chunk("IEND", Buffer.alloc(0))];
  return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), ...chunks]);
}

/** The normal map of a height that repeats over a side. */
function normalMap(side, height, strength) {
  const at = (x, y) => height((x + side) % side, (y + side) % side);
  return png(side, (x, y) => {
    // Rows go down, the map's y goes up.
    const slope = [(at(x - 1, y) - at(x + 1, y)) * strength, (at(x, y + 1) - at(x, y - 1)) * strength, 1];
    const length = Math.hypot(...slope);
    return slope.map((part) => (part / length) * 127.5 + 127.5);
  });
}

/** Numbers are written alike wherever this runs. */
const text = (...numbers) => numbers.map((number) => (Math.round(number * 1e4) / 1e4 || 0).toString()).join(" ");

/** Without normals: they are to be made from the triangles. y points up, as OBJ files mostly have it. */
function mountains(folder) {
  const { columns, rows, cell_m: cell, height_m: height } = MOUNTAINS;
  const ridges = octaves(11, 6, (n) => (1 - Math.abs(n)) ** 2, 0);
  const bend = octaves(31, 3, (n) => n, 0);
  const heightAt = (i, j) => {
    const [x, y] = [i / 28, j / 28];
    const warp = 0.6 * bend(x, y);
    // Down to the plain at the edges.
    const edge = Math.min(i, columns - i, j, rows - j) / 40;
    const fade = Math.min(1, edge) ** 2 * (3 - 2 * Math.min(1, edge));
    return height * fade * (ridges(x + warp, y - warp) / 2) ** 1.6;
  };
  const lines = ["# Mountains", "mtllib mountains.mtl", "o mountains"];
  for (let j = 0; j <= rows; j++) {
    for (let i = 0; i <= columns; i++) {
      lines.push(`v ${text((i - columns / 2) * cell, heightAt(i, j), (j - rows / 2) * cell)}`);
    }
  }
  for (let j = 0; j <= rows; j++) {
    for (let i = 0; i <= columns; i++) lines.push(`vt ${text((i / columns) * 24, (1 - j / rows) * 24)}`);
  }
  lines.push("usemtl slope");
  const corner = (i, j) => {
    const index = j * (columns + 1) + i + 1;
    return `${index}/${index}`;
  };
  for (let j = 0; j < rows; j++) {
    for (let i = 0; i < columns; i++) {
      const [a, b, c, d] = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
      lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
    }
  }
  const side = 256;
  const grain = octaves(71, 5, (n) => n, 8);
  const height2 = (x, y) => grain((x / side) * 8, (y / side) * 8);
  const material = ["newmtl slope", "Ka 1 1 1", "Kd 1 1 1", "Ks 0.02 0.02 0.02", "Ns 8", "map_Kd slope.png"];
  write(folder, "mountains", {
    "mountains.obj": lines.join("\n") + "\n",
    "mountains.mtl": [...material, "norm slope-normals.png"].join("\n") + "\n",
    "slope.png": png(side, (x, y) => [112, 108, 92].map((part) => part + 26 * height2(x, y))),
    "slope-normals.png": normalMap(side, height2, 3),
  });
}

/** Flat walls with a normal of their own for each face. */
function town(folder) {
  const { streets, houses, blocks, side_m: side } = TOWN;
  const lines = ["# A town", "mtllib town.mtl"];
  const groups = { street: [], wall: [], roof: [] };
  const count = { v: 0, vt: 0, vn: 0 };
  const add = (kind, ...numbers) => {
    lines.push(`${kind} ${text(...numbers)}`);
    count[kind] += 1;
    return count[kind];
  };
  // Corners anticlockwise as seen from outside; texture coordinates in metres along the face's first side and up.
  const face = (group, corners, metres) => {
    const [a, b, c] = corners;
    const [u, v] = [b.map((n, i) => n - a[i]), c.map((n, i) => n - a[i])];
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal);
    const along = u.map((n) => n / Math.hypot(...u));
    const unit = normal.map((n) => n / length);
    const up = [
      unit[1] * along[2] - unit[2] * along[1],
      unit[2] * along[0] - unit[0] * along[2],
      unit[0] * along[1] - unit[1] * along[0],
    ];
    const vn = add("vn", ...unit);
    const names = corners.map((corner) => {
      const way = corner.map((n, i) => n - a[i]);
      const on = (axis) => way.reduce((sum, n, i) => sum + n * axis[i], 0) / metres;
      return `${add("v", ...corner)}/${add("vt", on(along), on(up))}/${vn}`;
    });
    for (let i = 2; i < names.length; i++) groups[group].push(`f ${names[0]} ${names[i - 1]} ${names[i]}`);
  };
  const cell = side / streets;
  for (let j = 0; j < streets; j++) {
    for (let i = 0; i < streets; i++) {
      const [x, z] = [i * cell - side / 2, j * cell - side / 2];
      face("street", [[x, 0, z], [x, 0, z + cell], [x + cell, 0, z + cell], [x + cell, 0, z]], 8);
    }
  }
  const draw = random(5);
  const lot = side / 34;
  const lots = Array.from({ length: 33 * 33 }, (_, i) => i).filter((i) => i % 33 !== 16);
  const total = houses + blocks;
  for (let n = 0; n < total; n++) {
    const [i, j] = [lots[n] % 33, Math.floor(lots[n] / 33)];
    const [w, d] = [lot * (0.25 + 0.1 * draw()), lot * (0.25 + 0.1 * draw())];
    const [x, z] = [(i - 16) * lot + 2 * (draw() - 0.5), (j - 16) * lot + 2 * (draw() - 0.5)];
    // Taller towards the middle, and every fifth or so a house.
    const isHouse = Math.floor(((n + 1) * houses) / total) > Math.floor((n * houses) / total);
    const tall = Math.exp(-((x * x + z * z) / (side * 0.18) ** 2));
    const h = isHouse ? 5 + 4 * draw() : 9 + 10 * draw() + 60 * tall * draw();
    const ring = [[x - w, z + d], [x + w, z + d], [x + w, z - d], [x - w, z - d]];
    ring.forEach(([ax, az], k) => {
      const [bx, bz] = ring[(k + 1) % 4];
      face("wall", [[ax, 0, az], [bx, 0, bz], [bx, h, bz], [ax, h, az]], 3);
    });
    if (isHouse) {
      const top = h + 0.8 * d;
      const [left, right] = [[x - w, top, z], [x + w, top, z]];
      face("wall", [[x + w, h, z + d], [x + w, h, z - d], right], 3);
      face("wall", [[x - w, h, z - d], [x - w, h, z + d], left], 3);
      face("roof", [[x - w, h, z + d], [x + w, h, z + d], right, left], 4);
      face("roof", [[x + w, h, z - d], [x - w, h, z - d], left, right], 4);
    } else {
      face("roof", [[x - w, h, z + d], [x + w, h, z + d], [x + w, h, z - d], [x - w, h, z - d]], 4);
    }
  }
  for (const [group, faces] of Object.entries(groups)) lines.push(`g ${group}`, `usemtl ${group}`, ...faces);
  const size = 128;
  const grain = octaves(91, 4, (n) => n, 8);
  const rough = (x, y) => grain((x / size) * 8, (y / size) * 8);
  // Four rows of bricks, each half a brick aside.
  const brick = (x, y) => {
    const row = Math.floor((y / size) * 8);
    const [u, v] = [((x / size) * 4 + (row % 2) / 2) % 1, ((y / size) * 8) % 1];
    return u < 0.06 || v < 0.12 ? 0 : 1;
  };
  const material = (name, ks, ns, more = []) =>
    [`newmtl ${name}`, "Ka 1 1 1", "Kd 0.9 0.9 0.9", `Ks ${ks} ${ks} ${ks}`, `Ns ${ns}`, `map_Kd ${name}.png`, ...more];
  const shade = (colour, deep) => (x, y) => colour.map((part) => part + deep * rough(x, y));
  write(folder, "town", {
    "town.obj": lines.join("\n") + "\n",
    "town.mtl":
      [
        ...material("street", 0.02, 10),
        ...material("wall", 0.04, 20, ["norm wall-normals.png"]),
        ...material("roof", 0.06, 40),
      ].join("\n") + "\n",
    "street.png": png(size, shade([96, 96, 98], 14)),
    "wall.png": png(size, (x, y) => (brick(x, y) ? shade([184, 160, 132], 20) : shade([150, 146, 140], 8))(x, y)),
    "wall-normals.png": normalMap(size, (x, y) => brick(x, y) + 0.1 * rough(x, y), 0.6),
    "roof.png": png(size, shade([142, 74, 58], 18)),
  });
}

function write(folder, name, files) {
  mkdirSync(join(folder, name), { recursive: true });
  for (const [file, content] of Object.entries(files)) writeFileSync(join(folder, name, file), content);
}

const folder = process.argv[2];
if (!folder) {
  console.error("usage: node tests/tools/ground_assets.mjs FOLDER");
  process.exit(2);
}
mountains(folder);
town(folder);
