// For those who do not see the picture or use no pointer: role, name and hint of the view, sliders that screen
// readers operate by touch, and the view in words.
const speakAfter = 500; // milliseconds of rest before the new view is put in words
const radians = Math.PI / 180;
const hint = 'Arrow keys turn, plus and minus zoom, Home resets';

export class Access {
  #shadow;
  #orbit;
  #timer = 0;

  /**
   * @param {object} shadow parts of the element
   * @param {import('./orbit.js').Orbit} orbit
   * @param {(change: () => void) => void} move does what a slider asks for
   */
  constructor(shadow, orbit, move) {
    this.#shadow = shadow;
    this.#orbit = orbit;
    const { turn, tilt, distance } = shadow;
    const listen = (slider, change) => slider.addEventListener('input', () => move(() => change(Number(slider.value))));
    listen(turn, (value) => orbit.turn(value * radians - orbit.theta, 0));
    listen(tilt, (value) => orbit.turn(0, value * radians - (Math.PI / 2 - orbit.phi)));
    listen(distance, (value) => orbit.zoom(((value / 100) * orbit.framed.distance) / orbit.distance));
  }

  /** Takes over the attributes. */
  describe({ alt, cameraControls, disableZoom, touchAction }) {
    const { view, sliders, distance } = this.#shadow;
    view.setAttribute('role', cameraControls ? 'application' : 'img');
    view.setAttribute('aria-label', alt || 'Glass object');
    view.classList.toggle('active', cameraControls);
    view.style.touchAction = cameraControls ? touchAction : '';
    const controls = { tabindex: 0, 'aria-roledescription': '3D view', 'aria-description': hint };
    for (const [name, value] of Object.entries(controls)) {
      if (cameraControls) view.setAttribute(name, value);
      else view.removeAttribute(name);
    }
    sliders.hidden = !cameraControls;
    distance.disabled = disableZoom;
  }

  /** The sliders follow the view. */
  follow() {
    const { turn, tilt, distance } = this.#shadow;
    const { theta, phi, framed, distance: radius } = this.#orbit;
    const turned = Math.round(theta / radians);
    turn.value = ((((turned + 180) % 360) + 360) % 360) - 180;
    tilt.value = Math.round(90 - phi / radians);
    distance.value = Math.round((100 * radius) / framed.distance);
    for (const slider of [turn, tilt]) slider.setAttribute('aria-valuetext', `${slider.value} degrees`);
    distance.setAttribute('aria-valuetext', `${distance.value} percent`);
  }

  /** Says the view once it rests. */
  speak() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.follow();
      this.#shadow.status.textContent = this.#orbit.describe();
    }, speakAfter);
  }

  stop() {
    clearTimeout(this.#timer);
  }
}
