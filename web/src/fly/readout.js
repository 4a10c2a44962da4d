/** Where the camera is, how fast it goes and where it looks, in a line over the picture. */
import { byId, h } from '../dom.js';
import { degrees, distance } from '../text.js';
import { announce } from '../toast.js';
import { headingDeg } from './pose.js';

/** How long a change of speed is shown where the line is not. */
const SHOWN_MS = 2500;

/** @param {import('../camera.js').Camera} camera @param {import('./pilot.js').Pilot} pilot */
export function createReadout(camera, pilot) {
  const line = byId('position', HTMLDListElement);
  const rows = Object.fromEntries(
    [['height', 'Height'], ['place', 'East, north, up'], ['looking', 'Looking'], ['speed', 'Speed']].map(([key, name]) => {
      const value = h('dd', { 'data-position': key });
      line.append(h('div', {}, h('dt', {}, name), value));
      return [key, value];
    }),
  );
  let isOn = false;
  let timer = 0;
  const speedText = () => {
    const turbo = pilot.isTurbo() ? ', turbo' : '';
    return `${distance(pilot.speed())}/s, ×${pilot.factor()}${turbo}`;
  };
  const update = () => {
    if (line.hidden) return;
    const pose = camera.pose();
    rows.height.textContent = distance(pilot.height());
    rows.place.textContent = pose.position_m.map(distance).join('  ');
    rows.looking.textContent = `${degrees(headingDeg(pose, camera.radius()))} ${degrees(pose.pitch_deg)}`;
    rows.speed.textContent = speedText();
  };
  const show = (/** @type {boolean} */ shown) => {
    clearTimeout(timer);
    line.hidden = !shown;
    update();
  };
  return {
    update,
    isOn: () => isOn,
    toggle() {
      isOn = !isOn;
      show(isOn);
      announce(isOn ? `Height ${rows.height.textContent}; east, north, up ${rows.place.textContent}` : 'Position hidden');
    },
    /** The speed has changed. */
    speed() {
      show(true);
      announce(`Speed ${speedText()}`);
      if (!isOn) timer = window.setTimeout(() => show(false), SHOWN_MS);
    },
  };
}
