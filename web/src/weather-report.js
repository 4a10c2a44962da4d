/** A weather report (METAR) becomes the scene; what is wrong with a report is marked in it. */
import { postReport } from './api.js';
import { byId, h, uniqueId } from './dom.js';
import { announce } from './toast.js';

const EXAMPLE = 'METAR EGUW 030650Z 05003KT 0600 FG FEW060 12/12 Q1021';

/**
 * A text in which one part is marked. The server counts characters, not the halves of surrogate pairs.
 * @param {string} text @param {{start: number, end: number}} group
 */
export function parts(text, { start, end }) {
  const characters = Array.from(text);
  return [characters.slice(0, start), characters.slice(start, end), characters.slice(end)].map((part) => part.join(''));
}

/** What a scene keeps of the one before: the report says nothing of them. @param {any} scene @param {any} before */
const withViewOf = (scene, { camera, display }) => ({ ...scene, camera, display });

/** @param {import('./store.js').Store} store */
export function createWeatherReport(store) {
  const [bodyId, textId, errorId] = [uniqueId('report'), uniqueId('report'), uniqueId('report')];
  const fold = h('button', { type: 'button', class: 'fold', 'aria-expanded': 'false', 'aria-controls': bodyId }, 'Weather report');
  const text = h('textarea', { id: textId, rows: 3, maxlength: 4096, spellcheck: 'false', autocapitalize: 'characters', required: true, placeholder: EXAMPLE, 'aria-describedby': errorId });
  const date = h('input', { type: 'date', min: '1900-01-01', max: '2100-12-31', title: 'Reports tell neither month nor year: the last such moment up to this day. Empty: up to now.' });
  const button = h('button', { class: 'primary' }, 'Make it the scene');
  const echo = h('p', { class: 'echo', hidden: true });
  const error = h('p', { class: 'error', id: errorId, role: 'alert', hidden: true });
  const told = h('div', { class: 'told', role: 'status' });
  const form = h(
    'form',
    { class: 'group-body weather-report', id: bodyId, hidden: true },
    h('label', { for: textId }, 'METAR or SPECI'), text,
    echo, error,
    h('div', { class: 'row' }, h('label', {}, 'Up to', date), button),
    told,
  );
  byId('weather-report', HTMLElement).append(h('div', { class: 'group-head' }, fold), form);

  fold.addEventListener('click', () => {
    form.hidden = !form.hidden;
    fold.setAttribute('aria-expanded', String(!form.hidden));
    if (!form.hidden) text.focus();
  });

  const forget = () => {
    for (const element of [echo, error]) element.hidden = true;
    text.removeAttribute('aria-invalid');
  };
  /** @param {string} report @param {Error & {problem?: any}} failure */
  const complain = (report, failure) => {
    const group = failure.problem?.group;
    if (group) {
      const [before, wrong, after] = parts(report, group);
      echo.replaceChildren(before, h('mark', {}, wrong || '…'), after);
      text.setSelectionRange(before.length, before.length + wrong.length);
    }
    echo.hidden = !group;
    const message = failure.message.replaceAll('`', '');
    error.textContent = message.charAt(0).toUpperCase() + message.slice(1);
    error.hidden = false;
    text.setAttribute('aria-invalid', 'true');
    text.focus();
  };
  /** @param {any} answer */
  const tell = ({ report, notes, not_rendered }) => {
    const lines = [...notes, ...(not_rendered.length > 0 ? [`not shown: ${not_rendered.join(', ')}`] : [])];
    told.replaceChildren(
      h('p', {}, h('strong', {}, report.station), ` ${report.time.slice(0, 16).replace('T', ' ')} UTC`),
      h('ul', {}, ...lines.map((/** @type {string} */ line) => h('li', {}, line))),
    );
    announce(`The scene is the weather of ${report.station}.`);
  };

  text.addEventListener('input', forget);
  // A report is one line: Enter sends it.
  text.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' || event.shiftKey || event.isComposing) return;
    event.preventDefault();
    form.requestSubmit();
  });
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    forget();
    told.replaceChildren();
    button.disabled = true;
    const report = text.value;
    try {
      const answer = await postReport({ metar: report, date: date.value || null });
      store.load(withViewOf(answer.scene, store.scene));
      tell(answer);
    } catch (cause) {
      complain(report, /** @type {Error} */ (cause));
    } finally {
      button.disabled = false;
    }
  });
}
