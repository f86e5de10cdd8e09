// Parts of the page: pictures with what they show and the command that drew them.
export const escape = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
export const percent = (share) => `${(100 * share).toFixed(1)} %`;
export const text = (sentences) => `<p>${escape(sentences)}</p>`;

function figure(caption, picture) {
  if (!picture?.file) return `<figure><figcaption>${escape(caption)}</figcaption></figure>`;
  const { file, command, note } = picture, isSheet = command.includes('--layer-sheet') && !note; // several pictures beside one another
  return `<figure${isSheet ? ' class="wide"' : ''}><img src="${file}" alt="${escape(caption)}"><figcaption>${escape(caption)}
<code>${escape(command)}</code>${note ? ` ${escape(note)}` : ''}</figcaption></figure>`;
}

/** Figures beside one another: [caption, what is or promises a picture] each. */
export async function row(parts) {
  const drawn = await Promise.all(parts.map(async ([caption, picture]) => figure(caption, await picture)));
  return `<div class="row">\n${drawn.join('\n')}\n</div>`;
}
