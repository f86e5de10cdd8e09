// What is loaded once an element asks for it: hotspots, the hand that shows that the view can be turned, a picture behind.
import { fetchSource } from './loading.js';
import { decodePicture } from './picture.js';

export class Extras {
  #host;
  #stage;
  #told;
  #hotspots = null; // promise of them
  #prompt = null; // 'waiting', it, or 'seen'
  #timer = 0;

  /**
   * @param {HTMLElement} host
   * @param {import('./stage.js').Stage} stage
   * @param {object} told
   * @param {(cause: string, sentence: string) => void} told.say '': nothing is wrong
   * @param {(cause: string, sentence: string, reason: Error) => void} told.failed
   */
  constructor(host, stage, told) {
    this.#host = host;
    this.#stage = stage;
    this.#told = told;
  }

  /** Where the view now has them. */
  async placeHotspots() {
    if (this.#hotspots === null && !this.#host.querySelector(':scope > [slot^=hotspot]')) return;
    this.#hotspots ??= import('./hotspots.js').then(({ Hotspots }) => new Hotspots(this.#host), (reason) => {
      const sentence = this.#lacks('hotspots', reason);
      return { place: () => [sentence] };
    });
    this.#told.say('hotspots', (await this.#hotspots).place(this.#stage.view).join('. '));
  }

  /** As Backdrop.show. */
  async showBackdrop(wish, distance) {
    const stage = this.#stage;
    if (!wish && stage.backdrop === null) return;
    const { Backdrop } = await import('./backdrop.js').catch((reason) => this.#lacks('backdrop', reason));
    if (Backdrop) await (stage.backdrop ??= new Backdrop(this.#host, stage, this.#told, fetchSource, decodePicture)).show(wish, distance);
  }

  /** The hand comes after a while that nobody has touched the view. @param {object} values of the attributes @param {boolean} moves not where the visitor prefers reduced motion */
  awaitPrompt({ interactionPrompt, cameraControls, interactionPromptThreshold }, moves) {
    if (interactionPrompt !== 'auto' || !cameraControls || this.#prompt !== null) return;
    this.#prompt = 'waiting';
    this.#timer = setTimeout(async () => {
      const { Prompt } = await import('./prompt.js').catch((reason) => this.#lacks('prompt', reason));
      if (!Prompt || this.#prompt !== 'waiting') return;
      this.#prompt = new Prompt(this.#host.shadowRoot, moves, (right) => {
        this.#stage.orbit.turn(right, 0);
        this.#stage.moved();
      });
    }, interactionPromptThreshold);
  }

  /** Somebody has touched the view. */
  endPrompt() {
    this.stop();
    this.#prompt = 'seen';
  }

  /** The element is gone, perhaps to come back. */
  stop() {
    clearTimeout(this.#timer);
    this.#prompt?.stop?.();
    if (this.#prompt !== 'seen') this.#prompt = null;
  }

  #lacks(name, reason) {
    const sentence = `element/${name}.js cannot be loaded (${reason.message}); serve it with the element`;
    this.#told.failed(name, sentence, reason);
    return sentence;
  }
}
