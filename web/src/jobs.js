/** Jobs that the server has: how far each is, its latest frames, and what has come of it. */
import { getJson, stopJob } from './api.js';
import { byId, h } from './dom.js';
import { toast } from './toast.js';

const LOOK_MS = 1000;
/** Frames that a job shows. */
const SHOWN = 4;

/**
 * @typedef {{id: string, name: string | null, kind: string, format: string | null, state: string, frames: number,
 *   counts: Record<string, number>, rate_per_s: number, eta_s: number | null, ended_at: string | null,
 *   latest: number[], failures: {frame: number | null, reason: string}[], notes: string[], files: {name: string, bytes: number}[]}} Job
 */

/** @param {Job} job @param {string | number} name */
const resultOf = (job, name) => `v1/jobs/${job.id}/results/${name}`;

/** @param {number} seconds */
const span = (seconds) => (seconds < 90 ? `${Math.ceil(seconds)} s` : seconds < 5400 ? `${Math.ceil(seconds / 60)} min` : `${Math.ceil(seconds / 3600)} h`);

/** @param {Job} job */
function words({ state, counts, frames, rate_per_s, eta_s, ended_at }) {
  const parts = [state, `${counts.done} of ${frames}`];
  if (counts.failed > 0) parts.push(`${counts.failed} failed`);
  if (!ended_at && rate_per_s > 0) parts.push(`${rate_per_s.toFixed(rate_per_s < 10 ? 1 : 0)}/s`);
  if (eta_s !== null) parts.push(`${span(eta_s)} left`);
  return parts.join(' · ');
}

/** Numbers of the frames to show: the latest, and of a job that is done some from all of it. @param {Job} job */
function picked({ state, frames, latest }) {
  if (state !== 'done') return latest;
  return [...new Set(Array.from({ length: SHOWN }, (_, i) => Math.floor(((i + 0.5) * frames) / SHOWN)))];
}

/** A job's entry, kept while the job is listed, so that pictures that are there stay. @param {Job} first */
function createEntry(first) {
  const text = h('p', { class: 'note' });
  const bar = h('progress', { max: first.frames, 'aria-label': 'Frames done' });
  const pictures = h('div', { class: 'job-frames' });
  const more = h('div', { class: 'job-files' });
  const stop = h('button', { type: 'button', class: 'quiet', onclick: () => stopJob(first.id).catch((error) => toast(error.message, { bad: true })) }, 'Stop');
  const title = first.name ?? `${first.kind} of ${first.frames}`;
  const element = h('article', { class: 'job', 'data-job': first.id }, h('header', {}, h('h3', { title: first.id }, title), stop), bar, text, pictures, more);
  const isPicture = first.format === null ? first.kind !== 'panorama' : ['png', 'jpeg'].includes(first.format);
  /** @type {Map<number, HTMLImageElement>} */
  const images = new Map();
  const picture = (/** @type {Job} */ job, /** @type {number} */ number) => {
    const known = images.get(number);
    if (known) return known;
    const image = h('img', { src: resultOf(job, number), alt: `Frame ${number}`, title: `Frame ${number}`, loading: 'lazy' });
    images.set(number, image);
    return image;
  };
  let told = '';
  const update = (/** @type {Job} */ job) => {
    const now = JSON.stringify(job);
    if (now === told) return;
    told = now;
    element.dataset.state = job.state;
    bar.value = job.counts.done + job.counts.failed;
    text.textContent = words(job);
    stop.hidden = job.ended_at !== null;
    if (isPicture) pictures.replaceChildren(...picked(job).map((number) => h('a', { href: resultOf(job, number), target: '_blank' }, picture(job, number))));
    const film = job.files.find(({ name }) => /\.(mp4|webm)$/.test(name));
    const links = job.files.map(({ name }) => h('a', { href: resultOf(job, name), download: name }, name));
    const failures = job.failures.slice(0, 3).map(({ frame, reason }) => h('p', { class: 'error' }, `${frame === null ? 'The whole' : `Frame ${frame}`}: ${reason}`));
    const notes = job.notes.map((note) => h('p', { class: 'note' }, note));
    more.replaceChildren(film ? h('video', { src: resultOf(job, film.name), controls: true, loop: true, muted: true, preload: 'metadata' }) : '', ...links, ...failures, ...notes);
  };
  update(first);
  return { element, update };
}

export function createJobs() {
  const body = byId('jobs', HTMLElement).querySelector('.drawer-body');
  /** @type {Map<string, ReturnType<typeof createEntry>>} */
  const entries = new Map();
  let isOpen = false;
  let timer = 0;
  const show = (/** @type {Job[]} */ jobs) => {
    for (const job of jobs) {
      const known = entries.get(job.id);
      if (known) known.update(job);
      else entries.set(job.id, createEntry(job));
    }
    const elements = jobs.map(({ id }) => entries.get(id)?.element).filter((e) => e !== undefined);
    const isSame = body?.children.length === elements.length && elements.every((e, i) => body.children[i] === e);
    const empty = h('p', { class: 'note' }, 'No jobs yet. ', h('code', {}, 'welkin submit'), ' and ', h('code', {}, 'POST /v1/jobs'), ' send some.');
    if (!isSame) body?.replaceChildren(...(elements.length > 0 ? elements : [empty]));
  };
  const look = async () => {
    try {
      show((await getJson('v1/jobs?limit=20')).jobs);
    } catch (error) {
      if (entries.size === 0) body?.replaceChildren(h('p', { class: 'note' }, /** @type {Error} */ (error).message));
    }
    if (isOpen) timer = window.setTimeout(look, LOOK_MS);
  };
  return {
    opened: () => {
      isOpen = true;
      look();
    },
    closed: () => {
      isOpen = false;
      clearTimeout(timer);
    },
  };
}
