// Shows the examples: each alive, with its code and a button that copies it.
import '../element/vitrine-viewer.js';
import { examples, setup } from './examples.js';

function create(name, properties, ...children) {
  const node = Object.assign(document.createElement(name), properties);
  node.append(...children);
  return node;
}

/** Code, and a button that copies it. @param {string} what it shows, for the button's name */
function codeOf(code, what) {
  const text = create('code', { textContent: code });
  const button = create('button', { type: 'button', textContent: 'Copy' });
  button.setAttribute('aria-label', `Copy the code of ${what}`);
  const said = create('span', { className: 'said', role: 'status' });
  button.addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(code);
      said.textContent = 'Copied';
    } catch { // only pages of https may
      getSelection().selectAllChildren(text);
      said.textContent = 'Marked: press Ctrl+C or ⌘C';
    }
    setTimeout(() => (said.textContent = ''), 3000);
  });
  return create('div', { className: 'code' }, create('pre', {}, text), create('p', { className: 'copy' }, button, said));
}

document.getElementById('setup').append(codeOf(setup, 'the setup'));
document.getElementById('examples').append(...examples.map(({ title, text, code }) => {
  const shown = create('div', { className: 'shown', innerHTML: code });
  return create('article', {}, create('h2', { textContent: title }), create('p', { textContent: text }), shown, codeOf(code, `“${title}”`));
}));
