'use strict';

// Buttons do nothing without this script, so it is what shows them.
const textOf = (button) => document.getElementById(button.dataset.text).textContent;

function filmOf(button) {
  const video = document.getElementById(button.dataset.film).querySelector('video');
  const [head, letters] = video.getAttribute('src').split(',');
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

// A film that nobody touches shows its first frame, without controls over it.
for (const video of document.querySelectorAll('video')) {
  const rest = () => {
    const waits = video.paused && video.currentTime === 0;
    video.controls = !waits;
    video.parentElement.classList.toggle('waiting', waits);
  };
  const wake = () => {
    video.controls = true;
    video.parentElement.classList.remove('waiting');
  };
  video.tabIndex = 0;
  for (const what of ['pointerenter', 'focus', 'play']) video.addEventListener(what, wake);
  for (const what of ['pointerleave', 'blur']) video.addEventListener(what, rest);
  rest();
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
