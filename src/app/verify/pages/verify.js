'use strict';

const $ = (selector, from = document) => from.querySelector(selector);
const all = (selector, from = document) => [...from.querySelectorAll(selector)];

// Pictures lie in the page as text; what is not looked at is never decoded.
const sourceOf = (kind, id) => {
  const text = document.getElementById(`${kind}-${id}`);
  if (!text) return '';
  return text.dataset.as ? sourceOf(text.dataset.as, id) : 'data:image/png;base64,' + text.textContent.trim();
};

const NAMES = {expected: 'expected', actual: 'actual', difference: 'difference'};
const rows = all('#list li');
let shown = null;  // id
let mode = 'side';
let real = false;
let blinking = 0;

function say(words) {
  $('#said').textContent = words;
  clearTimeout(say.timer);
  say.timer = setTimeout(() => { $('#said').textContent = ''; }, 2500);
}

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

const image = (kind, id) => element('img', {src: sourceOf(kind, id), alt: NAMES[kind], decoding: 'async', draggable: false});

function framed(caption, content) {
  return element('figure', {}, element('figcaption', {textContent: caption}), element('div', {className: 'paper'}, content));
}

// Both pictures on top of each other; `top` is the second.
function pile(id) {
  const top = image('actual', id);
  return {top, whole: element('div', {className: 'pile'}, image('expected', id), top)};
}

function showSide(view, id, kinds) {
  view.append(element('div', {className: 'side'}, ...kinds.map((kind) => framed(NAMES[kind], image(kind, id)))));
}

function showSlider(view, id) {
  const {top, whole} = pile(id);
  const line = element('div', {className: 'line'});
  const range = element('input', {type: 'range', min: 0, max: 100, step: 0.1, value: 50, ariaLabel: 'how much is shown of the expected picture'});
  const place = () => {
    line.style.left = `${range.value}%`;
    const width = whole.getBoundingClientRect().width, cut = width * range.value / 100;
    top.style.clipPath = `inset(0 0 0 ${cut}px)`;
  };
  const follow = (event) => {
    const box = whole.getBoundingClientRect();
    range.value = 100 * (event.clientX - box.left) / box.width;
    place();
  };
  whole.append(line);
  whole.addEventListener('pointerdown', (event) => { whole.setPointerCapture(event.pointerId); follow(event); });
  whole.addEventListener('pointermove', (event) => { if (event.buttons) follow(event); });
  range.addEventListener('input', place);
  view.append(framed('left of the line expected, right of it actual', whole), range);
  new ResizeObserver(place).observe(whole);
  place();
}

function showBlink(view, id) {
  const {top, whole} = pile(id);
  const figure = framed('', whole), caption = $('figcaption', figure);
  const turn = () => {
    top.hidden = !top.hidden;
    caption.textContent = top.hidden ? NAMES.expected : NAMES.actual;
    $('img', whole).style.visibility = top.hidden ? '' : 'hidden';
  };
  view.append(figure);
  turn();
  blinking = setInterval(turn, 500);
}

// What can be shown of a picture, by the images that it has.
function modesOf(id) {
  const kinds = Object.keys(NAMES).filter((kind) => document.getElementById(`${kind}-${id}`));
  const modes = [];
  if (kinds.length) modes.push(['side', kinds.length > 1 ? 'side by side' : kinds[0], (view) => showSide(view, id, kinds)]);
  if (kinds.includes('expected') && kinds.includes('actual')) {
    modes.push(['slider', 'slider', (view) => showSlider(view, id)]);
    modes.push(['blink', 'blink', (view) => showBlink(view, id)]);
  }
  if (kinds.includes('difference')) modes.push(['difference', 'difference', (view) => showSide(view, id, ['difference'])]);
  return modes;
}

const viewOf = (id) => $('.view', document.getElementById(`picture-${id}`));

function clear(id) {
  clearInterval(blinking);
  viewOf(id).replaceChildren();
}

function draw() {
  clear(shown);
  const view = viewOf(shown), modes = modesOf(shown);
  if (!modes.length) return;
  const now = modes.find(([name]) => name === mode) || modes[0];
  const buttons = modes.map(([name, words]) => {
    const button = element('button', {type: 'button', textContent: words, ariaPressed: String(name === now[0])});
    button.dataset.mode = name;
    button.addEventListener('click', () => setMode(name));
    return button;
  });
  const size = element('button', {type: 'button', textContent: 'real size', ariaPressed: String(real)});
  size.addEventListener('click', toggleSize);
  const bar = element('div', {className: 'modes', role: 'group', ariaLabel: 'How the pictures are shown'}, ...buttons, size);
  view.append(bar);
  view.classList.toggle('real', real);
  now[2](view);
}

function setMode(name) {
  if (shown === null || !modesOf(shown).some(([one]) => one === name)) return say('This picture has nothing to show that way.');
  mode = name;
  draw();
}

function toggleSize() {
  if (shown === null) return;
  real = !real;
  draw();
}

function select(id, scrolls = true) {
  if (shown !== null) clear(shown);
  shown = id;
  for (const article of all('main article')) article.hidden = article.dataset.id !== id;
  for (const row of rows) {
    const link = $('a', row), current = row.dataset.id === id;
    if (current) link.setAttribute('aria-current', 'true'); else link.removeAttribute('aria-current');
    if (current && scrolls) link.scrollIntoView({block: 'nearest'});
  }
  if (id === null) return;
  draw();
}

// By the reader's hand: the address names the picture, so that it can be handed on.
function choose(id, scrolls = true) {
  select(id, scrolls);
  history.replaceState(null, '', `#picture-${id}`);
}

const listed = () => rows.filter((row) => !row.hidden);

function step(by) {
  const there = listed(), at = there.findIndex((row) => row.dataset.id === shown);
  const next = there[at + by];
  if (next) choose(next.dataset.id);
}

function filter() {
  const state = $('.chip[aria-pressed="true"]').dataset.filter, words = $('#search').value.toLowerCase().trim();
  for (const row of rows)
    row.hidden = (state !== '' && row.dataset.state !== state) || !row.dataset.words.toLowerCase().includes(words);
  const there = listed();
  $('#none').hidden = there.length > 0;
  if (!there.some((row) => row.dataset.id === shown)) select(there.length ? there[0].dataset.id : null);
}

async function copy(code) {
  try {
    await navigator.clipboard.writeText(code.textContent);
    say('Copied: ' + code.textContent);
  } catch {
    // Where a page may not write to the clipboard: selected, one key is left to press.
    getSelection().selectAllChildren(code);
    say('Selected: press Ctrl+C');
  }
}

function copyAccept() {
  const code = shown === null ? null : document.getElementById(`accept-${shown}`);
  if (code) copy(code); else say('There is nothing to accept here.');
}

// Small pictures in the list, as long as they are in sight.
const sight = new IntersectionObserver((entries) => {
  for (const {target, isIntersecting} of entries) {
    const id = target.closest('li').dataset.id, source = isIntersecting ? sourceOf('actual', id) || sourceOf('expected', id) : '';
    target.style.backgroundImage = source ? `url("${source}")` : '';
  }
}, {rootMargin: '200px'});
for (const thumb of all('.thumb')) sight.observe(thumb);

for (const row of rows)
  $('a', row).addEventListener('click', (event) => {
    event.preventDefault();
    choose(row.dataset.id, false);
    if (matchMedia('(max-width: 50rem)').matches) document.getElementById(`picture-${shown}`).scrollIntoView();
  });
for (const chip of all('.chip'))
  chip.addEventListener('click', () => {
    for (const other of all('.chip')) other.setAttribute('aria-pressed', String(other === chip));
    filter();
  });
$('#search').addEventListener('input', filter);
for (const button of all('button.copy')) {
  button.hidden = false;
  button.addEventListener('click', () => copy(document.getElementById(button.dataset.text)));
}
addEventListener('hashchange', () => {
  const id = location.hash.slice('#picture-'.length);
  if (rows.some((row) => row.dataset.id === id) && id !== shown) select(id);
});

const KEYS = {
  j: () => step(1), k: () => step(-1), a: copyAccept, s: () => setMode('side'), l: () => setMode('slider'),
  b: () => setMode('blink'), d: () => setMode('difference'), z: toggleSize, '/': () => $('#search').focus(),
};
addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.target === $('#search')) {
    if (event.key === 'Escape' || event.key === 'Enter') event.target.blur();
    return;
  }
  const action = KEYS[event.key];
  if (!action) return;
  event.preventDefault();
  action();
});

$('#keys').hidden = false;
const asked = location.hash.startsWith('#picture-') ? location.hash.slice('#picture-'.length) : '';
select(rows.some((row) => row.dataset.id === asked) ? asked : rows.length ? rows[0].dataset.id : null);
