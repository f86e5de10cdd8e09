// What the attributes say of the ground, for vtViewer_SetGround in the core.

/** Numbers between commas that fit, or null. @param {string} text @param {(numbers: number[]) => boolean} fits */
function readList(text, fits) {
  const numbers = text.split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));
  return numbers.every(Number.isFinite) && fits(numbers) ? numbers : null;
}

const isColor = (numbers, most) => numbers.length === 3 && numbers.every((value) => value >= 0 && value <= most);

function isSun([x, y, z, size = 0.53, ...color]) {
  const isUp = y > 0.02 * Math.hypot(x, y, z); // as vtValidateGround has it
  return isUp && size >= 0 && size <= 90 && (color.length === 0 || isColor(color, 1e6));
}

/**
 * @param {object} values of the element's attributes
 * @returns {{ground: number[], problems: string[]}} ground: there is one; intensity, softness; it is matt, colour;
 * direction of the sun, 0, 0, 0: the environment's own, size, irradiance
 */
export function readGround({ ground, groundColor, sun, shadowIntensity, shadowSoftness }) {
  const color = groundColor && readList(groundColor, (numbers) => isColor(numbers, 1));
  const light = sun && readList(sun, isSun);
  const intensity = shadowIntensity ?? Number(ground), isThere = ground || intensity > 0;
  const problems = [];
  if (color === null) problems.push(`ground-color is '${groundColor}'; it must be R,G,B, each from 0 to 1`);
  if (light === null) {
    problems.push(`sun is '${sun}'; it must be X,Y,Z towards it, which points up by more than a degree, then, if more is said, its size from 0 to 90 degrees, then its irradiance R,G,B, each from 0 to 1000000`);
  }
  for (const [name, value] of Object.entries({ 'ground-color': color, sun: light })) {
    if (value && !isThere) problems.push(`${name} says something of a ground; add ground`);
  }
  const [x, y, z, size, ...irradiance] = light || [0, 0, 0];
  const length = Math.hypot(x, y, z) || 1; // which floats may not hold
  return {
    ground: [Number(isThere), intensity, shadowSoftness, Number(Boolean(color)), ...(color || [0, 0, 0]),
      x / length, y / length, z / length, size ?? 0.53, ...(irradiance.length > 0 ? irradiance : [3, 3, 3])],
    problems,
  };
}
