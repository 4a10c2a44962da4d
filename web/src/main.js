/** Wiring: the only file that knows all the others. */
import { getJson } from './api.js';
import { bindAddress } from './address.js';
import { createCamera } from './camera.js';
import { carryOver } from './carry.js';
import { byId } from './dom.js';
import { createDome } from './dome.js';
import { createDrags } from './drag.js';
import { createDrawers } from './drawers.js';
import { createFlight } from './fly/flight.js';
import { createGallery } from './gallery.js';
import { listenToGestures } from './gestures.js';
import { createHud } from './hud.js';
import { createLamps } from './lamps/drawer.js';
import { createJobs } from './jobs.js';
import { bindings, fillHelp, listenToKeys } from './keys.js';
import { createMark } from './mark.js';
import { createMoon } from './moon.js';
import { createPainter } from './paint/painter.js';
import { createPanel } from './panel.js';
import { createPresets } from './presets.js';
import { createSave } from './save.js';
import { readSchema } from './schema.js';
import { createShare } from './share.js';
import { createSky } from './sky.js';
import { createStage } from './stage.js';
import { createStore } from './store.js';
import { createSun } from './sun.js';
import { createSurprise } from './surprise.js';
import { createTerrainFiles } from './terrain/files.js';
import { createTimePlace } from './time-place.js';
import { createTimelineBar } from './timeline/bar.js';
import { createPlayer } from './timeline/player.js';
import { toast } from './toast.js';
import { createWeatherReport } from './weather-report.js';

/** The preset whose clouds stand in where a scene has none. */
const FAIR = 'fair-weather';

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
  const terrain = createTerrainFiles(store, { drop: canvas });
  const presets = createPresets(store, presetList);
  const fair = presets.all.find(({ name }) => name === FAIR)?.scene.clouds;
  const player = createPlayer(() => performance.now());
  const timeline = createTimelineBar(store, player);
  const painter = createPainter(store, stage, fair, () => drawers.show('painter'));
  const lamps = createLamps({ store, camera, stage, sun, surface: canvas });
  const gallery = createGallery(presets);
  const surprise = createSurprise(store, byId('surprise', HTMLButtonElement), fair);
  const sky = createSky({ store, stage, sun, moon, hud, player, stopped: timeline.refused, refused: (pointer, message) => panel.complain(pointer, message) || complain(message) });
  const known = { sun: sun.angles, moon: moon.place, ev: sky.exposure, timeAndPlace: timePlace.current, mapName: painter.mapName, meshName: terrain.meshName, townName: lamps.townName, mountains: terrain.mountains, heightfields: terrain.heightfields };
  const suggestions = (/** @type {string} */ pointer) => {
    if (pointer === '/terrain/name') return terrain.names();
    if (pointer === '/town/name') return lamps.names();
    return pointer.endsWith('/name') ? painter.names() : [];
  };
  const panel = createPanel(store, (value, fresh) => carryOver(value, fresh, known), known, suggestions);
  const narrow = window.matchMedia('(max-width: 720px)');
  const drawers = createDrawers({ gallery, painter, lamps, jobs: createJobs() }, () => narrow.matches && panel.show(false));
  panel.onShow(() => narrow.matches && drawers.close());
  createShare(store, address.link, stage.size);
  const save = createSave(store, stage.size);
  const help = byId('help', HTMLDialogElement);
  const flight = createFlight(canvas, store, camera, sun, () => timePlace.current().latitude_deg);
  const keys = bindings({
    sun,
    camera,
    flight,
    preset: presets.choose,
    panel: panel.toggle,
    device: hud.toggle,
    bare: () => document.body.classList.toggle('bare'),
    save: save.open,
    play: timeline.playOrPause,
    surprise,
    help: () => help.showModal(),
  });
  fillHelp(keys);
  listenToKeys(keys, flight);
  byId('open-help', HTMLButtonElement).addEventListener('click', () => help.showModal());
  byId('open-save', HTMLButtonElement).addEventListener('click', save.open);
  listenToGestures(canvas, createDrags({ sun, moon, camera, stage }), camera, lamps.tap);
  if (narrow.matches) panel.show(false);

  sky.run([panel, presets, gallery, painter, lamps, timeline, timePlace, terrain, createDome(store, sun, moon), createMark(sun, camera, stage), flight], flight.step);
}

start().catch((error) => complain(`The page cannot start: ${error.message}`));
