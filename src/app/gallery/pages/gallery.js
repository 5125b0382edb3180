'use strict';

// Buttons do nothing without this script, so it is what shows them.
const textOf = (button) => document.getElementById(button.dataset.text).textContent;

function filmOf(button) {
  const moving = document.getElementById(button.dataset.film).querySelector('video, img.moving');
  const [head, letters] = moving.getAttribute('src').split(',');
  const bytes = Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0));
  return new Blob([bytes], {type: head.slice('data:'.length, head.indexOf(';'))});
}

function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

function element(name, properties, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

// A browser's own controls lie over the film's lower edge, where its words are: these stand below it. The picture that stands
// for a film shows until somebody plays it, with a small button about its middle, where it covers least; so long its instant is told.
for (const video of document.querySelectorAll('video')) {
  const title = document.getElementById(video.getAttribute('aria-labelledby')).textContent;
  const film = video.parentElement;
  const start = element('button', {type: 'button', className: 'start', ariaLabel: 'Play ' + title});
  const play = element('button', {type: 'button', className: 'play', ariaLabel: 'Play ' + title});
  const place = element('input', {type: 'range', min: 0, max: 1000, value: 0, step: 1, ariaLabel: 'Place in the film'});
  const time = element('output', {});
  const whole = element('button', {type: 'button', className: 'whole', ariaLabel: 'Full screen', hidden: !document.fullscreenEnabled});
  const frame = element('div', {className: 'frame'});
  video.controls = false;
  video.tabIndex = 0;
  film.classList.add('own');
  video.replaceWith(frame);
  start.style.left = video.dataset.buttonLeft + '%';
  start.style.top = video.dataset.buttonTop + '%';
  frame.append(video, start);
  film.append(element('div', {className: 'controls'}, play, place, time, whole));

  const toggle = () => (video.paused ? video.play() : video.pause());
  const go = (seconds) => { video.currentTime = Math.min(Math.max(seconds, 0), video.duration || 0); };
  let isPoster = true;
  for (const what of ['play', 'seeking']) video.addEventListener(what, () => { isPoster = false; });
  const show = () => {
    const length = video.duration || 0;
    const at = isPoster ? Math.min(Number(video.dataset.posterAt), length) : video.currentTime;
    start.hidden = !video.paused || video.currentTime > 0;
    play.textContent = video.paused ? '\u25B6' : '\u2016';
    play.ariaLabel = (video.paused ? 'Play ' : 'Pause ') + title;
    if (document.activeElement !== place || !video.paused) place.value = length > 0 ? 1000 * at / length : 0;
    place.ariaValueText = at.toFixed(1) + ' of ' + length.toFixed(1) + ' seconds';
    time.textContent = at.toFixed(1) + ' / ' + length.toFixed(1) + ' s';
  };
  for (const what of ['play', 'pause', 'timeupdate', 'seeked', 'loadedmetadata', 'emptied']) video.addEventListener(what, show);
  for (const button of [start, play, video]) button.addEventListener('click', toggle);
  place.addEventListener('input', () => go(place.value / 1000 * video.duration));
  whole.addEventListener('click', () => (document.fullscreenElement ? document.exitFullscreen() : video.requestFullscreen()));

  const keys = {
    ' ': toggle, k: toggle, ArrowLeft: () => go(video.currentTime - 1), ArrowRight: () => go(video.currentTime + 1),
    Home: () => go(0), End: () => go(video.duration), f: () => whole.click(),
  };
  film.addEventListener('keydown', (event) => {
    const own = event.target instanceof HTMLInputElement || (event.target instanceof HTMLButtonElement && event.key === ' ');
    if (own || event.ctrlKey || event.altKey || event.metaKey || !(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  });
  show();
}

// A picture that is small on the page is large above it at a click: as wide as its words need, to be moved about.
const large = element('dialog', {className: 'large', ariaLabel: 'Enlarged picture'});
const shut = element('button', {type: 'button', textContent: 'Close'});
large.addEventListener('click', () => large.close());
document.body.append(large);
for (const picture of document.querySelectorAll('figure img')) {
  const enlarge = element('button', {type: 'button', className: 'enlarge', ariaLabel: 'Enlarge ' + picture.alt});
  picture.replaceWith(enlarge);
  enlarge.append(picture);
  enlarge.addEventListener('click', () => {
    large.replaceChildren(shut, picture.cloneNode());
    large.showModal();
  });
}

for (const button of document.querySelectorAll('button.save')) {
  button.hidden = false;
  button.addEventListener('click', () => {
    save(button.dataset.film ? filmOf(button) : new Blob([textOf(button)], {type: 'text/yaml'}), button.dataset.name);
  });
}

for (const button of document.querySelectorAll('button.copy')) {
  button.hidden = false;
  button.addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(textOf(button));
      button.textContent = 'Copied';
    } catch {
      // Where a page may not write to the clipboard: selected, one key is left to press.
      getSelection().selectAllChildren(document.getElementById(button.dataset.text));
      button.textContent = 'Selected: press Ctrl+C';
    }
    setTimeout(() => { button.textContent = 'Copy'; }, 2000);
  });
}
