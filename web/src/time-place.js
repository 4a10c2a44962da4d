/** Time and place: sets the sun by date, hour and position on the Earth. */
import { toSolar, toUtc, clockText } from './clock.js';
import { byId, h, uniqueId } from './dom.js';
import { PLACES } from './places.js';
import { isTimed, POSITION } from './sun.js';
import { toast } from './toast.js';

const DAY_MINUTES = 24 * 60;
const NOON = `${new Date().toISOString().slice(0, 10)}T12:00:00Z`;

/** @typedef {{time: string, latitude_deg: number, longitude_deg: number, refraction: boolean}} TimeAndPlace */

/** @param {import('./store.js').Store} store */
export function createTimePlace(store) {
  /** What the fields show while the sun is given by a direction. @type {TimeAndPlace} */
  let remembered = { time: NOON, latitude_deg: PLACES[0][1], longitude_deg: PLACES[0][2], refraction: true };
  const current = () => remembered;
  const set = (/** @type {Partial<TimeAndPlace>} */ change) => store.set(POSITION, { ...remembered, ...change });
  const solar = () => toSolar(remembered.time, remembered.longitude_deg);

  const bodyId = uniqueId('time-place');
  const fold = h('button', { type: 'button', class: 'fold', 'aria-expanded': 'false', 'aria-controls': bodyId }, 'Time and place');
  const on = h('input', { type: 'checkbox', class: 'switch', 'aria-label': 'Sun by time and place' });
  const place = h('select', { 'aria-label': 'Place' }, h('option', { value: '' }, 'Elsewhere'), ...PLACES.map(([name], i) => h('option', { value: i }, name)));
  const here = h('button', { type: 'button' }, 'My location');
  const latitude = h('input', { type: 'number', min: -90, max: 90, step: 0.1 });
  const longitude = h('input', { type: 'number', min: -180, max: 180, step: 0.1 });
  const date = h('input', { type: 'date', min: '1900-01-01', max: '2100-12-31' });
  const day = h('input', { type: 'range', min: 0, max: DAY_MINUTES - 1, step: 1, 'aria-label': 'Local solar time', id: 'day' });
  const solarText = h('strong');
  const utcText = h('span');
  const body = h(
    'div',
    { class: 'group-body time-place', id: bodyId, hidden: true },
    h('div', { class: 'row' }, place, here),
    h('div', { class: 'row' }, h('label', {}, 'Latitude °N', latitude), h('label', {}, 'Longitude °E', longitude)),
    h('label', {}, 'Date', date),
    h('div', {}, day, h('p', { class: 'clock' }, solarText, utcText)),
  );
  byId('time-place', HTMLElement).append(h('div', { class: 'group-head' }, fold, on), body);

  const open = (/** @type {boolean} */ shown) => {
    body.hidden = !shown;
    fold.setAttribute('aria-expanded', String(shown));
  };
  fold.addEventListener('click', () => open(Boolean(body.hidden)));
  on.addEventListener('change', () => {
    if (on.checked) set({});
    else leave();
    open(on.checked);
  });
  /** @type {() => void} */
  let leave = () => {};
  /** Keeps the hour of the sun, not of the clock. */
  const moveTo = (/** @type {number} */ latitude_deg, /** @type {number} */ longitude_deg) =>
    set({ latitude_deg, longitude_deg, time: toUtc(solar(), longitude_deg) });
  place.addEventListener('change', () => {
    const chosen = PLACES[Number(place.value)];
    if (place.value !== '' && chosen) moveTo(chosen[1], chosen[2]);
  });
  here.addEventListener('click', () =>
    navigator.geolocation.getCurrentPosition(
      ({ coords }) => moveTo(Number(coords.latitude.toFixed(3)), Number(coords.longitude.toFixed(3))),
      ({ message }) => toast(`The browser does not tell where you are: ${message || 'not allowed'}`, { bad: true }),
    ),
  );
  for (const input of [latitude, longitude]) {
    input.addEventListener('input', () => {
      if (latitude.value && longitude.value) moveTo(latitude.valueAsNumber, longitude.valueAsNumber);
    });
  }
  date.addEventListener('change', () => date.value && set({ time: toUtc({ ...solar(), date: date.value }, remembered.longitude_deg) }));
  day.addEventListener('input', () => set({ time: toUtc({ ...solar(), hours: day.valueAsNumber / 60 }, remembered.longitude_deg) }));

  const show = (/** @type {HTMLInputElement} */ input, /** @type {number} */ value) => {
    if (input.valueAsNumber !== value) input.valueAsNumber = value;
  };
  return {
    current,
    /** What turns the sun back to a direction. @param {() => void} act */
    onLeave: (act) => (leave = act),
    update() {
      const position = store.get(POSITION);
      on.checked = isTimed(position);
      if (on.checked && !Number.isNaN(Date.parse(position.time))) remembered = position;
      const { date: shownDate, hours } = solar();
      show(latitude, remembered.latitude_deg);
      show(longitude, remembered.longitude_deg);
      date.value = shownDate;
      day.valueAsNumber = Math.round(hours * 60);
      day.style.setProperty('--filled', `${(hours / 24) * 100}%`);
      day.setAttribute('aria-valuetext', `${clockText(hours)} solar time`);
      const found = PLACES.findIndex(([, lat, lon]) => lat === remembered.latitude_deg && lon === remembered.longitude_deg);
      place.value = found < 0 ? '' : String(found);
      solarText.textContent = `${clockText(hours)} solar`;
      utcText.textContent = `${remembered.time.slice(0, 10)} ${remembered.time.slice(11, 16)} UTC`;
    },
  };
}
