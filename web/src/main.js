/** Wiring: the only file that knows all the others. */
import { getJson } from './api.js';
import { bindAddress } from './address.js';
import { createCamera } from './camera.js';
import { carryOver } from './carry.js';
import { byId } from './dom.js';
import { createDome } from './dome.js';
import { createDrags } from './drag.js';
import { listenToGestures } from './gestures.js';
import { createHud } from './hud.js';
import { bindings, fillHelp, listenToKeys } from './keys.js';
import { createMark } from './mark.js';
import { createMoon } from './moon.js';
import { createPanel } from './panel.js';
import { createPresets } from './presets.js';
import { createSave } from './save.js';
import { readSchema } from './schema.js';
import { createShare } from './share.js';
import { createSky } from './sky.js';
import { createStage } from './stage.js';
import { createStore } from './store.js';
import { createSun } from './sun.js';
import { createTimePlace } from './time-place.js';
import { toast } from './toast.js';
import { createWeatherReport } from './weather-report.js';

const complain = (/** @type {string} */ message) => toast(message, { bad: true });

async function start() {
  const [schema, presetList, device] = await Promise.all(['v1/schema/scene', 'v1/presets', 'v1/device'].map(getJson));
  const store = createStore(readSchema(schema));
  const canvas = byId('sky', HTMLCanvasElement);
  const stage = createStage(canvas);
  const sun = createSun(store);
  const moon = createMoon(store);
  const camera = createCamera(store, stage);
  const hud = createHud();
  hud.device(device);
  const address = bindAddress(store, complain);

  const timePlace = createTimePlace(store);
  timePlace.onLeave(() => sun.nudge(0, 0));
  createWeatherReport(store);
  const sky = createSky({ store, stage, sun, moon, hud, refused: (pointer, message) => panel.complain(pointer, message) || complain(message) });
  const known = { sun: sun.angles, moon: moon.place, ev: sky.exposure, timeAndPlace: timePlace.current };
  const panel = createPanel(store, (value, fresh) => carryOver(value, fresh, known), known);
  const presets = createPresets(store, presetList);
  createShare(store, address.link, stage.size);
  const save = createSave(store, stage.size);
  const help = byId('help', HTMLDialogElement);
  const keys = bindings({
    sun,
    camera,
    preset: presets.choose,
    panel: panel.toggle,
    bare: () => document.body.classList.toggle('bare'),
    save: save.open,
    help: () => help.showModal(),
  });
  fillHelp(keys);
  listenToKeys(keys);
  byId('open-help', HTMLButtonElement).addEventListener('click', () => help.showModal());
  byId('open-save', HTMLButtonElement).addEventListener('click', save.open);
  listenToGestures(canvas, createDrags({ sun, moon, camera, stage }), camera);
  if (window.matchMedia('(max-width: 720px)').matches) panel.show(false);

  sky.run([panel, presets, timePlace, createDome(store, sun, moon), createMark(sun, camera, stage)]);
}

start().catch((error) => complain(`The page cannot start: ${error.message}`));
