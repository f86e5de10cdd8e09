// Rows of squares before a backdrop, each of another material, with the light that must come from it: what the texts of
// glTF 2.0 and its extensions say, worked out by hand. Numbers are linear light.
import { ball, box, colored, model, matt, quad, solid, thin, unlit, withSecond } from './case-models.mjs';

const backdrop = [0.5, 0.6, 0.8];
const tint = [0.5, 0.25, 0.9];
const paint = [0.3, 0.7, 0.2];
const F = 0.04; // of index 1.5, straight on
const times = (a, b) => a.map((x, i) => x * (Array.isArray(b) ? b[i] : b));
const plus = (a, b) => a.map((x, i) => x + b[i]);
const [red, green, blue, white] = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]];

/** Half a turn about y; a quarter about z. */
const turned = [0, 1, 0, 0];

/**
 * Squares of side 0.8, the i-th about x = i; the camera stands 40 before the middle one.
 * @param {{pngOf: (width: number, height: number, pixels: number[][]) => Buffer}} tools
 */
export function rows({ pngOf }) {
  const base = () => ({ pbr: { baseColorTexture: { index: 0 } } });
  const four = pngOf(2, 2, [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]]);
  const halves = (left, right) => pngOf(2, 1, [left, right]);
  const nearest = { magFilter: 9728, minFilter: 9728 };
  const clear = times(backdrop, 1 - F);
  const behindTint = times(clear, tint);
  const transform = (values) => ({ index: 0, extensions: { KHR_texture_transform: values } });
  const ior = (value) => ({ KHR_materials_ior: { ior: value } });
  const specular = (values) => ({ KHR_materials_specular: values });
  const film = (thickness, values) => ({ KHR_materials_iridescence: { iridescenceFactor: 1, iridescenceIor: 1.3, iridescenceThicknessMaximum: thickness, ...values } });
  const left = [-0.2, 0], right = [0.2, 0];
  const corners = [[-0.2, 0.2], [0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]];
  /** What the four quarters of a square show, upper left, upper right, lower left, lower right. */
  const quarters = (...colors) => colors.map((value, i) => ({ at: corners[i], value }));
  /** The picture of four colours with a linear filter, about the last square. */
  const blended = (x, y) => {
    const share = (along) => Math.min(Math.max(2 * along - 0.5, 0), 1), [u, v] = [share((x + 0.4) / 0.8), share((0.4 - y) / 0.8)];
    return red.map((_, k) => (1 - v) * ((1 - u) * red[k] + u * green[k]) + v * ((1 - u) * blue[k] + u * white[k]));
  };
  const second = withSecond(quad(), (u, v) => [1 - u, v]);

  // Of lights at (0, 0, 2): 4 pi / pi / distance^2 * cosine.
  const lamp = { lightAt: [0, 0, 2] };
  const reaching = (x, y) => 8 / Math.hypot(x, y, 2) ** 3;
  const lit = (value) => Object.fromEntries([-2, -1, 0, 1, 2].map((x) => [`at ${x}`, { material: matt(paint, { extensions: specular({ specularFactor: 0 }) }), value }]));

  return {
    'thin walls': {
      tiles: {
        clear: { material: thin(), value: clear },
        tinted: { material: thin(tint), value: behindTint },
        'volume of thickness 0': { material: thin(tint, { extensions: { KHR_materials_volume: { thicknessFactor: 0, attenuationColor: [0, 0, 0], attenuationDistance: 0.01 } } }), value: behindTint },
        'index 1': { material: thin(tint, { extensions: ior(1) }), value: times(backdrop, tint) },
        'index 2': { material: thin(tint, { extensions: ior(2) }), value: times(times(backdrop, tint), 8 / 9) },
        'index 0': { material: thin(tint, { extensions: ior(0) }), value: [0, 0, 0] },
        'specular 0': { material: thin(tint, { extensions: specular({ specularFactor: 0 }) }), value: times(backdrop, tint) },
        'specular of a colour': { material: thin([1, 1, 1], { extensions: { ...ior(3), ...specular({ specularColorFactor: [0, 1, 2] }) } }), value: times(backdrop, [1, 0.75, 0.5]) },
        'a quarter passes': { material: thin(tint, { extensions: { KHR_materials_transmission: { transmissionFactor: 0.25 } } }), value: times(behindTint, 0.25) },
        'a hundredth passes': { material: thin([1, 1, 1], { extensions: { KHR_materials_transmission: { transmissionFactor: 0.01 } } }), value: times(clear, 0.01) },
        metal: { material: thin(tint, { pbr: { metallicFactor: 1 } }), value: [0, 0, 0] },
        'half a metal': { material: thin(tint, { pbr: { metallicFactor: 0.5 } }), value: times(behindTint, 0.5) },
        'alpha without a mode': { material: thin([...tint, 0.3]), value: behindTint },
        glowing: { material: thin([1, 1, 1], { emissiveFactor: [0.1, 0.2, 0] }), value: plus(clear, [0.1, 0.2, 0]) },
        'from behind': { material: thin(tint), rotation: turned, value: behindTint },
        'from behind, two-sided': { material: thin(tint, { doubleSided: true }), rotation: turned, value: behindTint },
        'vertex colours': { mesh: colored(quad(), 0.5, 0.25, 0.9, 0.2), material: thin(), value: behindTint },
      },
    },
    'solid glass': {
      mesh: box(0.8, 0.8, 0.2),
      tiles: {
        clear: { material: solid(), value: times(clear, 1 - F), within: 3 },
        tinted: { material: solid(tint), value: times(times(behindTint, 1 - F), tint) },
        absorbing: { material: solid(white, { extensions: { KHR_materials_volume: { thicknessFactor: 0.01, attenuationColor: tint, attenuationDistance: 0.2 } } }), value: times(behindTint, 1 - F) },
        'absorbing, scaled': { scale: [1, 1, 2], material: solid(white, { extensions: { KHR_materials_volume: { thicknessFactor: 9, attenuationColor: tint, attenuationDistance: 0.4 } } }), value: times(behindTint, 1 - F) },
        'negative scale': { scale: [-1, 1, 1], material: solid(tint), value: times(times(behindTint, 1 - F), tint) },
        'all scales negative': { scale: [-1, -1, -1], material: solid(tint), value: times(times(behindTint, 1 - F), tint) },
        'index 1, tinted': { material: solid(tint, { extensions: ior(1) }), value: times(times(backdrop, tint), tint) },
        'index 1, absorbing': { material: solid(white, { extensions: { ...ior(1), KHR_materials_volume: { thicknessFactor: 1, attenuationColor: tint, attenuationDistance: 0.1 } } }), value: times(times(backdrop, tint), tint) },
        'index 0': { material: solid(tint, { extensions: ior(0) }), value: [0, 0, 0] },
        'specular 0': { material: solid(tint, { extensions: specular({ specularFactor: 0 }) }), value: times(times(backdrop, tint), tint) },
        'vertex colours': { mesh: colored(box(0.8, 0.8, 0.2), 0.5, 0.25, 0.9, 1), material: solid(), value: times(times(behindTint, 1 - F), tint) },
        'alpha without a mode': { material: solid([...tint, 0.1]), value: times(times(behindTint, 1 - F), tint) },
      },
    },
    sides: {
      tiles: {
        front: { material: unlit(paint), value: paint },
        back: { material: unlit(paint), rotation: turned, value: backdrop },
        'back of two sides': { material: unlit(paint, { doubleSided: true }), rotation: turned, value: paint },
        'front, mirrored': { material: unlit(paint), scale: [-1, 1, 1], value: paint },
        'back, mirrored': { material: unlit(paint), scale: [-1, 1, 1], rotation: turned, value: backdrop },
        'back with a hole': { material: unlit([...paint, 0.5], { alphaMode: 'BLEND' }), rotation: turned, value: backdrop },
        'a box, mirrored': { mesh: box(0.8, 0.8, 0.4), material: unlit(paint), scale: [1, 1, -1], value: paint },
      },
    },
    coverage: {
      pictures: [halves([255, 255, 255, 102], [255, 255, 255, 153]), halves([255, 255, 255, 51], [255, 255, 255, 204])],
      samplers: [nearest], textures: [{ source: 0, sampler: 0 }, { source: 1, sampler: 0 }],
      tiles: {
        'holes of the usual cutoff': { material: unlit(paint, { alphaMode: 'MASK', ...base() }), points: [{ at: left, value: backdrop }, { at: right, value: paint }] },
        'holes by a cutoff': { material: unlit(paint, { alphaMode: 'MASK', alphaCutoff: 0.3, pbr: { baseColorTexture: { index: 1 } } }), points: [{ at: left, value: backdrop }, { at: right, value: paint }] },
        'all of it a hole': { material: unlit(paint, { alphaMode: 'MASK', alphaCutoff: 0.7, ...base() }), points: [{ at: left, value: backdrop }, { at: right, value: backdrop }] },
        'no hole': { material: unlit(paint, { alphaMode: 'MASK', alphaCutoff: 0, ...base() }), points: [{ at: left, value: paint }, { at: right, value: paint }] },
        'a quarter': { material: unlit([...paint, 0.25], { alphaMode: 'BLEND' }), value: plus(times(paint, 0.25), times(backdrop, 0.75)) },
        'by a picture': { material: unlit(paint, { alphaMode: 'BLEND', pbr: { baseColorTexture: { index: 1 } } }), points: [{ at: left, value: plus(times(paint, 0.2), times(backdrop, 0.8)) }, { at: right, value: plus(times(paint, 0.8), times(backdrop, 0.2)) }] },
        'by vertex colours': { mesh: colored(quad(), 1, 1, 1, 0.5), material: unlit(paint, { alphaMode: 'BLEND' }), value: plus(times(paint, 0.5), times(backdrop, 0.5)) },
        'by all three': { mesh: colored(quad(), 1, 1, 1, 0.5), material: unlit([...paint, 0.5], { alphaMode: 'BLEND', pbr: { baseColorFactor: [...paint, 0.5], baseColorTexture: { index: 1 } } }), points: [{ at: right, value: plus(times(paint, 0.2), times(backdrop, 0.8)) }] },
        'no mode, no alpha': { material: unlit([...paint, 0.1], { pbr: { baseColorFactor: [...paint, 0.1], baseColorTexture: { index: 0 } } }), points: [{ at: left, value: paint }] },
        'a thin wall': { material: thin([...tint, 0.25], { alphaMode: 'BLEND' }), value: plus(times(backdrop, 0.75), times(behindTint, 0.25)) },
        'a black thin wall': { material: thin([0, 0, 0, 0.25], { alphaMode: 'BLEND' }), value: times(backdrop, 0.75) },
        'a thin wall with a hole': { material: thin(tint, { alphaMode: 'MASK', pbr: { ...base().pbr, roughnessFactor: 0 } }), points: [{ at: left, value: backdrop }, { at: right, value: behindTint }] },
        'a body with a hole': { mesh: box(0.8, 0.8, 0.2), material: solid(tint, { alphaMode: 'MASK', pbr: { ...base().pbr, roughnessFactor: 0 } }), points: [{ at: left, value: backdrop }, { at: right, value: times(times(behindTint, 1 - F), tint) }] },
      },
    },
    'a closed body with holes': {
      // The back's picture is the other way about: a ray that comes in through a hole leaves through glass.
      pictures: [halves([255, 255, 255, 102], [255, 255, 255, 153])], samplers: [nearest], textures: [{ source: 0, sampler: 0 }],
      tiles: {
        'holes across from glass': {
          mesh: (() => {
            const mesh = box(0.8, 0.8, 0.2);
            return { ...mesh, texcoords: mesh.texcoords.map((at, i) => (i % 2 === 0 && mesh.positions[3 * (i / 2) + 2] < 0 ? 1 - at : at)) };
          })(),
          material: solid(tint, { alphaMode: 'MASK', pbr: { ...base().pbr, roughnessFactor: 0 } }),
          points: [{ at: left, value: behindTint }, { at: right, value: behindTint }],
        },
      },
    },
    'a body with holes in its front only': {
      // Its back has another material: light comes in through the hole, and leaves through the glass of the back.
      pictures: [halves([255, 255, 255, 102], [255, 255, 255, 153])], samplers: [nearest], textures: [{ source: 0, sampler: 0 }],
      tiles: {
        open: {
          primitives: (() => {
            const all = box(0.8, 0.8, 0.2), front = all.indices.slice(30), rest = all.indices.slice(0, 30);
            return [{ mesh: { ...all, indices: front }, material: solid(tint, { alphaMode: 'MASK', pbr: { ...base().pbr, roughnessFactor: 0 } }) },
              { mesh: { ...all, indices: rest }, material: solid([0.8, 0.8, 0.8]) }];
          })(),
          points: [{ at: left, value: times(clear, 0.8) }, { at: right, value: times(times(behindTint, 1 - F), 0.8) }],
        },
      },
    },
    'pictures as they lie': {
      pictures: [four], samplers: [nearest, { ...nearest, wrapS: 33071, wrapT: 33071 }, { ...nearest, wrapS: 33648, wrapT: 33648 }, {}],
      textures: [0, 1, 2, 3].map((sampler) => ({ source: 0, sampler })),
      tiles: {
        upright: { material: unlit(white, base()), points: quarters(red, green, blue, white) },
        'second coordinates': { mesh: second, material: unlit(white, { pbr: { baseColorTexture: { index: 0, texCoord: 1 } } }), points: quarters(green, red, white, blue) },
        'second by the transform': { mesh: second, material: unlit(white, { pbr: { baseColorTexture: { index: 0, extensions: { KHR_texture_transform: { texCoord: 1 } } } } }), points: quarters(green, red, white, blue) },
        'first by the transform': { mesh: second, material: unlit(white, { pbr: { baseColorTexture: { index: 0, texCoord: 1, extensions: { KHR_texture_transform: { texCoord: 0 } } } } }), points: quarters(red, green, blue, white) },
        moved: { material: unlit(white, { pbr: { baseColorTexture: transform({ offset: [0.5, 0] }) } }), points: quarters(green, red, white, blue) },
        // u' = v, v' = -u, which goes on from the other side.
        'turned by 90 degrees': { material: unlit(white, { pbr: { baseColorTexture: transform({ rotation: Math.PI / 2 }) } }), points: quarters(blue, red, white, green) },
        // u' = v + 1/2, v' = -u: turned, then moved.
        'turned, moved': { material: unlit(white, { pbr: { baseColorTexture: transform({ rotation: Math.PI / 2, offset: [0.5, 0] }) } }), points: quarters(white, green, blue, red) },
        // u' = v, v' = -2u: scaled first.
        'scaled, turned': { material: unlit(white, { pbr: { baseColorTexture: transform({ rotation: Math.PI / 2, scale: [2, 1] }) } }), points: [{ at: [-0.3, 0.2], value: blue }, { at: [-0.1, 0.2], value: red }, { at: [0.3, -0.2], value: green }] },
        repeated: { material: unlit(white, { pbr: { baseColorTexture: transform({ scale: [2, 2] }) } }), points: [{ at: [-0.3, 0.3], value: red }, { at: [-0.1, 0.3], value: green }, { at: [0.1, 0.3], value: red }, { at: [0.1, 0.1], value: blue }] },
        clamped: { material: unlit(white, { pbr: { baseColorTexture: { ...transform({ scale: [4, 4], offset: [-1.5, -1.5] }), index: 1 } } }), points: quarters(red, green, blue, white) },
        mirrored: { material: unlit(white, { pbr: { baseColorTexture: { ...transform({ scale: [2, 2] }), index: 2 } } }), points: [{ at: [-0.3, 0.3], value: red }, { at: [-0.1, 0.3], value: green }, { at: [0.1, 0.3], value: green }, { at: [0.3, 0.3], value: red }, { at: [0.1, 0.1], value: white }] },
        'upside down': { material: unlit(white, { pbr: { baseColorTexture: transform({ scale: [1, -1], offset: [0, 1] }) } }), points: quarters(blue, white, red, green) },
        blended: { material: unlit(white, { pbr: { baseColorTexture: { index: 3 } } }), points: [[-0.2, 0.2], [0, 0.2], [0.1, -0.1]].map((at) => ({ at, value: blended })) },
      },
    },
    'pictures of everything': {
      pictures: [four, halves([255, 255, 255, 255], [0, 0, 0, 0]), halves([255, 0, 0, 255], [255, 255, 255, 255]),
        pngOf(5, 3, Array.from({ length: 15 }, (_, i) => [i % 5 === 4 ? 255 : 0, i < 5 ? 255 : 0, 188, 255]))],
      samplers: [nearest], textures: [0, 1, 2, 3].map((source) => ({ source, sampler: 0 })),
      tiles: {
        'light of its own': { material: matt([0, 0, 0], { emissiveFactor: [0.25, 0.25, 0.25], emissiveTexture: { index: 0 }, extensions: { KHR_materials_emissive_strength: { emissiveStrength: 2 } } }), points: quarters(...[red, green, blue, white].map((color) => times(color, 0.5))) },
        'on thin glass': { material: thin(white, base()), points: quarters(...[red, green, blue, white].map((color) => times(color, clear))) },
        'on solid glass': { mesh: box(0.8, 0.8, 0.2), material: solid(white, base()), points: quarters(...[red, green, blue, white].map((color) => times(times(color, clear), 1 - F))) },
        'glass that glows': { material: thin(white, { emissiveFactor: [0.1, 0.1, 0.1], emissiveTexture: { index: 0 } }), points: quarters(...[red, green, blue, white].map((color) => plus(times(color, 0.1), clear))) },
        transmission: { material: thin(tint, { extensions: { KHR_materials_transmission: { transmissionFactor: 1, transmissionTexture: { index: 2 } }, ...specular({ specularFactor: 0 }) } }), points: [{ at: left, value: times(backdrop, tint) }, { at: right, value: times(backdrop, tint) }] },
        'no transmission': { material: thin(tint, { extensions: { KHR_materials_transmission: { transmissionFactor: 0.8, transmissionTexture: { index: 1 } } } }), points: [{ at: left, value: times(behindTint, 0.8) }, { at: right, value: [0, 0, 0] }] },
        metal: { material: thin(tint, { pbr: { metallicFactor: 1, metallicRoughnessTexture: { index: 1 } } }), points: [{ at: left, value: [0, 0, 0] }, { at: right, value: behindTint }] },
        specular: { material: thin(tint, { extensions: { ...ior(3), ...specular({ specularTexture: { index: 1 } }) } }), points: [{ at: left, value: times(times(backdrop, tint), 0.75) }, { at: right, value: times(backdrop, tint) }] },
        'specular colour': { material: thin(white, { extensions: { ...ior(3), ...specular({ specularColorTexture: { index: 2 } }) } }), points: [{ at: left, value: times(backdrop, [0.75, 1, 1]) }, { at: right, value: times(backdrop, 0.75) }] },
        'of another size': { material: unlit(white, { pbr: { baseColorTexture: { index: 3 } } }), points: [{ at: [-0.32, 0.27], value: [0, 1, 0.503] }, { at: [0.32, 0.27], value: [1, 1, 0.503] }, { at: [0.32, 0], value: [1, 0, 0.503] }, { at: [0.16, -0.27], value: [0, 0, 0.503] }] },
      },
    },
    'exposed by -1': {
      args: ['--exposure', '-1'], exposure: 0.5,
      tiles: {
        unlit: { material: unlit([0.9, 0.05, 0.4]), value: [0.9, 0.05, 0.4] },
        'unlit glass is opaque': { material: thin([0.9, 0.05, 0.4], { extensions: { KHR_materials_unlit: {} } }), value: [0.9, 0.05, 0.4] },
        'behind a thin wall': { material: thin(tint), value: behindTint },
        glowing: { material: matt([0, 0, 0], { emissiveFactor: [0.5, 1, 0.2] }), value: [0.25, 0.5, 0.1] },
        'unlit, vertex colours': { mesh: colored(quad(), 0.5, 1, 0.1, 1), material: unlit([0.8, 0.8, 0.8]), value: [0.4, 0.8, 0.08] },
      },
    },
    'lit from the front': {
      lights: [{ type: 'directional', intensity: Math.PI }],
      pictures: [pngOf(1, 1, [[128, 128, 255, 255]]), pngOf(1, 1, [[204, 128, 230, 255]]), pngOf(1, 1, [[0, 255, 255, 255]]), pngOf(1, 1, [[128, 204, 230, 255]])],
      tiles: {
        matt: { material: matt(paint, { extensions: specular({ specularFactor: 0 }) }), value: paint },
        // GGX of roughness 1 straight on: D = 1 / pi, V = 1 / 4, so pi * D * V = 1 / 4 of what is reflected.
        'with what it reflects': { material: matt(paint), value: plus(paint, [0.01, 0.01, 0.01]) },
        'specular of a colour': { material: matt([0.1, 0.1, 0.1], { extensions: { ...ior(3), ...specular({ specularColorFactor: [0, 1, 4] }) } }), value: [0.1, 0.1625, 0.35] },
        metal: { material: matt(paint, { pbr: { metallicFactor: 1 } }), value: times(paint, 0.25) },
        'vertex colours': { mesh: colored(quad(), 0.5, 0.2, 1, 0), material: matt([0.8, 0.8, 0.8], { extensions: specular({ specularFactor: 0 }) }), value: [0.4, 0.16, 0.8] },
        'a flat normal map': { material: matt(paint, { normalTexture: { index: 0 }, extensions: specular({ specularFactor: 0 }) }), value: paint },
        // N = (0.6, 0, 0.8), then (0.3, 0, 0.8), normalized.
        'a normal map': { material: matt(paint, { normalTexture: { index: 1 }, extensions: specular({ specularFactor: 0 }) }), value: times(paint, 0.801) },
        'half as strong': { material: matt(paint, { normalTexture: { index: 1, scale: 0.5 }, extensions: specular({ specularFactor: 0 }) }), value: times(paint, 0.9368) },
        'metal and roughness by a picture': { material: matt(paint, { pbr: { metallicFactor: 1, metallicRoughnessTexture: { index: 2 } } }), value: times(paint, 0.25) },
        'from behind, two-sided': { rotation: turned, material: matt(paint, { doubleSided: true, extensions: specular({ specularFactor: 0 }) }), value: paint },
      },
    },
    // The normal map leans to +u, or to -v in the picture, which is up: with the light or against it.
    'lit from the side': {
      lights: [{ type: 'directional', intensity: Math.PI }], lightTurned: [0, Math.sin(0.3), 0, Math.cos(0.3)], // from (sin 0.6, 0, cos 0.6)
      pictures: [pngOf(1, 1, [[204, 128, 230, 255]]), pngOf(1, 1, [[128, 204, 230, 255]])],
      tiles: Object.fromEntries([
        ['flat', {}, Math.cos(0.6)],
        ['leaning', { normalTexture: { index: 0 } }, 0.598 * Math.sin(0.6) + 0.801 * Math.cos(0.6)],
        ['leaning away, mirrored', { normalTexture: { index: 0 }, scale: [-1, 1, 1] }, -0.598 * Math.sin(0.6) + 0.801 * Math.cos(0.6)],
        ['leaning away, turned', { normalTexture: { index: 0 }, rotation: [0, 0, 1, 0] }, -0.598 * Math.sin(0.6) + 0.801 * Math.cos(0.6)],
        ['turned picture', { normalTexture: { index: 0, extensions: { KHR_texture_transform: { scale: [1, 1] } } } }, 0.598 * Math.sin(0.6) + 0.801 * Math.cos(0.6)],
        ['leaning up', { normalTexture: { index: 1 } }, 0.801 * Math.cos(0.6)],
        ['leaning up, a quarter turned', { normalTexture: { index: 1 }, rotation: [0, 0, -Math.SQRT1_2, Math.SQRT1_2] }, 0.598 * Math.sin(0.6) + 0.801 * Math.cos(0.6)],
      ].map(([name, { normalTexture, ...node }, share]) => [name, { ...node, material: matt(paint, { ...(normalTexture && { normalTexture }), extensions: specular({ specularFactor: 0 }) }), value: times(paint, share) }])),
    },
    'in white surroundings': {
      environment: 'white', backdrop: [0, 0, 0],
      pictures: [pngOf(1, 1, [[128, 0, 0, 255]])],
      tiles: {
        'index 0 reflects all': { material: thin(tint, { extensions: ior(0) }), value: white },
        'index 0, specular of a colour': { material: thin(tint, { extensions: { ...ior(0), ...specular({ specularFactor: 0.5, specularColorFactor: [1, 0.5, 2] }) } }), value: [0.5, 0.25, 0.5] },
        'a thin wall reflects': { material: thin(), value: [F, F, F] },
        'index 3': { material: thin(white, { extensions: ior(3) }), value: [0.25, 0.25, 0.25] },
        'specular 0 reflects nothing': { material: thin(white, { extensions: specular({ specularFactor: 0 }) }), value: [0, 0, 0] },
        'a metal reflects': { material: matt([0.9, 0.5, 0.2], { pbr: { metallicFactor: 1, roughnessFactor: 0 } }), value: [0.9, 0.5, 0.2], within: 3 },
        'matt, no specular': { material: matt(paint, { extensions: specular({ specularFactor: 0 }) }), value: paint },
        occluded: { material: matt(paint, { occlusionTexture: { index: 0 }, extensions: specular({ specularFactor: 0 }) }), value: times(paint, 128 / 255) },
        'occluded by half of that': { material: matt(paint, { occlusionTexture: { index: 0, strength: 0.5 }, extensions: specular({ specularFactor: 0 }) }), value: times(paint, 0.5 + 64 / 255) },
        // A quarter wave of 550 nm at index 1.3 on 1.5: ((1.5 - 1.69) / (1.5 + 1.69))^2 = 0.0035 is left; half a wave changes nothing.
        'a film of a quarter wave': { material: thin(white, { extensions: film(105.8) }), points: [{ at: [0, 0], value: [null, 0.0045, null], within: 6 }] },
        'a film of half a wave': { material: thin(white, { extensions: film(211.5) }), points: [{ at: [0, 0], value: [null, 0.038, null], within: 4 }] },
        'a film of nothing': { material: thin(white, { extensions: film(0, { iridescenceThicknessMinimum: 0 }) }), value: [F, F, F] },
        'an opaque film of a quarter wave': { material: matt([0, 0, 0], { pbr: { roughnessFactor: 0 }, extensions: film(105.8) }), points: [{ at: [0, 0], value: [null, 0.0045, null], within: 6 }] },
        'half a film': { material: thin(white, { extensions: film(105.8, { iridescenceFactor: 0.5 }) }), points: [{ at: [0, 0], value: [null, 0.0222, null], within: 4 }] },
      },
    },
    // Light of 4 pi cd at a distance of 2 before the middle.
    'a point light': {
      ...lamp, lights: [{ type: 'point', intensity: 4 * Math.PI }], tiles: lit((x, y) => times(paint, reaching(x, y))),
    },
    'a point light of range 4': {
      ...lamp, lights: [{ type: 'point', intensity: 4 * Math.PI, color: [1, 0.5, 0.25], range: 4 }],
      tiles: lit((x, y) => times(times(paint, reaching(x, y) * (1 - ((x * x + y * y + 4) / 16) ** 2)), [1, 0.5, 0.25])),
    },
    'a spot light': {
      ...lamp, lights: [{ type: 'spot', intensity: 4 * Math.PI, spot: { innerConeAngle: 0.2, outerConeAngle: 0.6 } }],
      tiles: lit((x, y) => {
        const cosine = 2 / Math.hypot(x, y, 2), [inner, outer] = [Math.cos(0.2), Math.cos(0.6)];
        return times(paint, reaching(x, y) * Math.min(Math.max((cosine - outer) / (inner - outer), 0), 1) ** 2);
      }),
    },
    'thirty sheets of index 1': {
      tiles: {
        thin: { mesh: null, sheets: 30, material: thin([0.97, 0.95, 0.9], { extensions: ior(1) }), value: times(backdrop, [0.97 ** 30, 0.95 ** 30, 0.9 ** 30]) },
      },
    },
    'one body of two materials': {
      tiles: {
        box: {
          primitives: (() => {
            const all = box(0.8, 0.8, 0.2);
            return [{ mesh: { ...all, indices: all.indices.slice(30) }, material: solid([1, 0.5, 0.5]) }, { mesh: { ...all, indices: all.indices.slice(0, 30) }, material: solid([0.5, 0.5, 1]) }];
          })(),
          value: times(times(clear, 1 - F), [0.5, 0.25, 0.5]),
        },
        ball: {
          primitives: [{ mesh: ball(0.4, 16, 0, 8), material: solid([0.6, 0.9, 0.9]) }, { mesh: ball(0.4, 16, 8, 16), material: solid([0.9, 0.9, 0.6]) }],
          points: [],
        },
      },
    },
  };
}

const distance = 40, pixels = 24; // of a square and what is about it

/** What is drawn of a row: its file, what the command line and the element take, and the points with their values. */
export function drawingOf({ tiles, mesh = quad(), environment = 'black', backdrop: wall = backdrop, args = [], exposure = 1, lightAt, lightTurned, lights, ...more }) {
  const names = Object.keys(tiles), middle = (names.length - 1) / 2, points = [], width = pixels * names.length;
  const parts = [{ mesh: quad(names.length + 4, 4), material: unlit(wall), translation: [0, 0, -3] }];
  parts.push({ mesh: quad(), material: thin(), translation: [0, 3, 0] }); // out of sight: a file without glass is made all glass
  names.forEach((name, i) => {
    const { value, points: several, within, sheets = 1, material, primitives, mesh: own, ...node } = tiles[name];
    for (let k = 0; k < sheets; ++k) {
      const shape = primitives ? { primitives } : { mesh: own ?? mesh, material };
      parts.push({ ...shape, translation: [i - middle, 0, -0.05 * k], ...node });
    }
    for (const point of several ?? [{ at: [0, 0], value }]) {
      const [x, y] = [Math.floor(pixels * (i + 0.5 + point.at[0])), Math.floor(pixels * (0.5 - point.at[1]))];
      // A value that depends on the place is that at the pixel's centre; of `blended` each square has its own.
      const [column, row] = [(x + 0.5) / pixels - 0.5 - (lights ? middle : i), 0.5 - (y + 0.5) / pixels];
      const { value: wanted } = point;
      points.push({ name, within: within ?? 2, ...point, x, y, value: typeof wanted === 'function' ? wanted(column, row) : wanted });
    }
  });
  if (lights) parts.push({ extensions: { KHR_lights_punctual: { light: 0 } }, ...(lightAt && { translation: lightAt }), ...(lightTurned && { rotation: lightTurned }) });
  const fov = (360 / Math.PI) * Math.atan(0.5 / distance);
  return { file: model(parts, { lights, ...more }), width, height: pixels, environment, exposure, points, camera: [0, 0, distance], target: [0, 0, 0], fov, args };
}
