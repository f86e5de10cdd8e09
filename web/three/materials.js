// What three.js's materials are to the core: vtThreeMaterial of web/three/three.h.
import { NearestFilter, RepeatWrapping } from 'three';

export const materialWords = 141; // of vtThreeMaterial

/** Does Vitrine draw it? drei's MeshTransmissionMaterial keeps its transmission under another name. */
export function isGlass(material) {
  return Boolean(material?.isMeshPhysicalMaterial && material.visible && !material.wireframe && transmissionOf(material) > 0);
}

const transmissionOf = (material) => material._transmission ?? material.transmission ?? 0;
const clamp01 = (number) => Math.min(Math.max(number ?? 0, 0), 1);

// In the order of vtMapUse: property, whether its numbers are linear.
const maps = [
  ['map', false], ['roughnessMap', true], ['transmissionMap', true], ['normalMap', true], ['aoMap', true], ['emissiveMap', false],
  ['specularIntensityMap', true], ['specularColorMap', false], ['iridescenceMap', true], ['iridescenceThicknessMap', true],
];

const leftOut = ['clearcoat', 'sheen', 'anisotropy', 'alphaMap', 'bumpMap', 'displacementMap', 'envMap', 'clippingPlanes'];

/** The sentence of what a material has that glass is drawn without; ''. */
function tellLeftOut(material) {
  const names = leftOut.filter((name) => material[name] > 0 || material[name]?.isTexture || material[name]?.length > 0);
  return names.length > 0 ? `material '${material.name || material.uuid}': glass is drawn without its ${names.join(', ')}` : '';
}

/** vtThreeMap. three.js's v rises, the core's falls; wrapping is numbered in the order of vtWrap. */
function writeMap(texture, image, floats, words, at) {
  words.fill(0, at, at + 11);
  words[at] = image; // -1: none
  floats[at + 5] = floats[at + 9] = 1;
  if (image < 0) return;
  words.set([texture.channel ?? 0, texture.wrapS - RepeatWrapping, texture.wrapT - RepeatWrapping, Number(texture.magFilter === NearestFilter)], at + 1);
  if (texture.matrixAutoUpdate) texture.updateMatrix();
  const e = texture.matrix.elements;
  floats.set([e[0], e[3], e[6], -e[1], -e[4], 1 - e[7]], at + 5);
}

function writeColor(floats, at, color, scale = 1) {
  floats[at] = scale * (color?.r ?? 1);
  floats[at + 1] = scale * (color?.g ?? 1);
  floats[at + 2] = scale * (color?.b ?? 1);
}

/** Least and greatest thickness of its film: three.js has them under other names since 0.187. */
function filmOf(material) {
  const { iridescenceThicknessMinimum: low, iridescenceThicknessMaximum: high } = material;
  return low !== undefined ? [low, high] : material.iridescenceThicknessRange ?? [100, 400];
}

/** How the material's alpha is looked at: vtAlpha. */
function alphaModeOf({ alphaTest, transparent, opacity }) {
  return alphaTest > 0 ? 1 : transparent && opacity < 1 ? 2 : 0;
}

/**
 * Writes a material.
 * @param material of three.js's @param {boolean} isOpaque it is marked as one that glass sees exactly
 * @param {{tint: ?import('three').Color, intensity: number, pictures, note}} more a colour of the instance; what surroundings are multiplied by; images; where to tell what is left out
 */
export function writeMaterial(material, isOpaque, { tint, intensity, pictures, note }, floats, words, at) {
  const isUnlit = isOpaque && material.isMeshBasicMaterial === true;
  const thickness = material.thickness ?? 0, distance = material.attenuationDistance;
  words.set([Number(isOpaque), Number(!isOpaque && thickness === 0), Number(isUnlit), alphaModeOf(material)], at);
  floats.set([
    material.ior ?? 1.5, clamp01(transmissionOf(material)), distance > 0 && distance < Infinity ? distance : 0, clamp01(material.metalness),
    clamp01(material.roughness ?? 1), clamp01(material.opacity), clamp01(material.alphaTest || 0.5), clamp01(material.specularIntensity ?? 1),
    clamp01(material.iridescence), material.iridescenceIOR ?? 1.3, ...filmOf(material),
    Math.min(Math.max(material.dispersion ?? 0, 0), 20), material.normalScale?.x ?? 1, material.aoMapIntensity ?? 1,
  ], at + 4);
  writeColor(floats, at + 19, material.color);
  if (tint) ['r', 'g', 'b'].forEach((part, i) => (floats[at + 19 + i] *= tint[part]));
  for (let i = 0; i < 3; ++i) floats[at + 19 + i] = clamp01(floats[at + 19 + i]);
  writeColor(floats, at + 22, distance < Infinity ? material.attenuationColor : null);
  writeColor(floats, at + 25, material.emissive, material.emissive ? (material.emissiveIntensity ?? 1) / intensity : 0);
  writeColor(floats, at + 28, material.specularColor);
  maps.forEach(([name, linear], i) => {
    const texture = material[name] ?? (name === 'roughnessMap' ? material.metalnessMap : null);
    const image = texture ? pictures.use(texture, linear, name === 'normalMap' && material.normalScale.y < 0) : -1;
    writeMap(texture, image, floats, words, at + 31 + 11 * i);
  });
  const sentence = isOpaque ? '' : tellLeftOut(material);
  if (sentence) note(sentence);
}
