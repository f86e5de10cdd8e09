// Small scenes, each of which shows one thing of glTF's materials from end to end: what golden images are drawn of.
import { ball, box, colored, matt, model, quad, solid, thin, unlit, withSecond } from './case-models.mjs';

const ior = (value) => ({ KHR_materials_ior: { ior: value } });
const specular = (specularFactor, specularColorFactor = [1, 1, 1]) => ({ KHR_materials_specular: { specularFactor, specularColorFactor } });
const film = (thickness, iridescenceIor = 1.3) => ({ KHR_materials_iridescence: { iridescenceFactor: 1, iridescenceIor, iridescenceThicknessMaximum: thickness } });
const volume = (thicknessFactor, attenuationColor, attenuationDistance) => ({ KHR_materials_volume: { thicknessFactor, ...(attenuationColor && { attenuationColor, attenuationDistance }) } });
const transmission = (transmissionFactor) => ({ KHR_materials_transmission: { transmissionFactor } });
const transform = (values, more) => ({ index: 1, ...more, extensions: { KHR_texture_transform: values } });
const globe = ball(0.42, 12);

/** Columns of items, 1 apart, about the origin. @param {object[][]} rows from top to bottom; null: nothing there */
const grid = (rows) => rows.flatMap((row, j) => row.flatMap((item, i) => (item ? [{ translation: [i - (row.length - 1) / 2, (rows.length - 1) / 2 - j, 0], ...item }] : [])));

/**
 * By name: a .glb, and what more the command line takes.
 * @param {(width: number, height: number, pixels: number[][]) => Buffer} pngOf
 * @returns {Record<string, {file: Buffer, args: string[]}>}
 */
export function goldenModels(pngOf) {
  const checker = pngOf(8, 8, Array.from({ length: 64 }, (_, i) => ((i ^ (i >> 3)) & 1 ? [70, 70, 75, 255] : [220, 215, 200, 255])));
  // An F with an arrow's asymmetry: red above, green left, blue below, on white.
  const letter = pngOf(6, 6, ['rrrrrr', 'gwwwww', 'grrrww', 'gwwwww', 'gwwwww', 'gbbwww'].flatMap((row) => [...row].map((c) => ({ r: [220, 30, 30, 255], g: [20, 160, 60, 255], b: [30, 60, 220, 255], w: [245, 245, 245, 255] })[c])));
  const fading = pngOf(16, 1, Array.from({ length: 16 }, (_, i) => [255, 255, 255, 17 * i]));
  // Bumps: a pyramid whose slopes lean outwards.
  const bumps = pngOf(4, 4, Array.from({ length: 16 }, (_, i) => [i % 4 < 2 ? 70 : 186, i < 8 ? 186 : 70, 225, 255]));
  const pictures = [checker, letter, fading, bumps], samplers = [{ magFilter: 9728, minFilter: 9728 }, { magFilter: 9728, minFilter: 9728, wrapS: 33071, wrapT: 33071 }, { magFilter: 9728, minFilter: 9728, wrapS: 33648, wrapT: 33648 }];
  const textures = [{ source: 0, sampler: 0 }, { source: 1, sampler: 0 }, { source: 2, sampler: 1 }, { source: 3, sampler: 0 }, { source: 1, sampler: 1 }, { source: 1, sampler: 2 }];
  const wall = { mesh: quad(8, 6), material: matt([1, 1, 1], { pbr: { baseColorTexture: { index: 0 } } }), translation: [0, 0, -1.6] };
  const hidden = { mesh: quad(), material: thin(), translation: [0, 90, 0] }; // a file without glass is made all glass
  const scene = (columns, parts, { lit, args = [] } = {}) => {
    const lights = lit && [{ type: 'directional', intensity: 2 }];
    const lamp = lit ? [{ rotation: [-0.25, 0.3, 0, 0.92], extensions: { KHR_lights_punctual: { light: 0 } } }] : [];
    return { file: model([wall, hidden, ...parts, ...lamp], { pictures, samplers, textures, lights }), args: ['-e', 'sky', '--camera', `0,0,${1.5 * columns}`, '--target', '0,0,0', '--fov', '30', ...args] };
  };

  return {
    transmission: scene(3, grid([
      [0, 0.5, 1].map((share) => ({ mesh: quad(), material: thin([0.9, 0.5, 0.2], { extensions: transmission(share), pbr: { roughnessFactor: 0.4 } }) })),
      [0, 0.5, 1].map((share) => ({ mesh: globe, material: solid([0.5, 0.9, 0.6], { extensions: transmission(share) }) })),
    ])),
    'transmission-roughness': scene(4, grid([0, 1].map((metallicFactor) => [0, 0.3, 0.6, 1].map((roughnessFactor) => ({ mesh: globe, material: solid([0.9, 0.9, 1], { pbr: { roughnessFactor, metallicFactor: metallicFactor / 2 } }) })))), { lit: true }),
    attenuation: scene(4, grid([
      [0.1, 0.2, 0.4, 0.8].map((depth) => ({ mesh: box(0.8, 0.8, depth), material: solid([1, 1, 1], { extensions: volume(depth, [0.2, 0.6, 0.9], 0.4) }) })),
      [0.1, 0.2, 0.4, 0.8].map((distance) => ({ mesh: globe, material: solid([1, 1, 1], { extensions: volume(1, [0.9, 0.4, 0.2], distance) }) })),
      [0.25, 0.5, 1, 2].map((scale) => ({ mesh: box(0.8, 0.8, 0.4), scale: [1, 1, scale], material: solid([0.9, 1, 0.9], { extensions: volume(0.01, [0.2, 0.9, 0.3], 0.4) }) })),
    ])),
    ior: scene(4, grid([[1, 1.1, 1.33, 1.5], [1.76, 2.42, 4, 0]].map((row) => row.map((index) => ({ mesh: globe, material: solid([0.95, 1, 0.95], { extensions: ior(index) }) }))))),
    'thin-wall': scene(4, grid([
      [1, 1.5, 2.4, 0].map((index) => ({ mesh: quad(), rotation: [0, 0.3, 0, 0.954], material: thin([0.6, 0.8, 1], { extensions: ior(index) }) })),
      [0, 0.5].flatMap((thicknessFactor) => [{ mesh: globe, material: thin([0.6, 0.8, 1], { extensions: volume(thicknessFactor) }) }, { mesh: box(0.7, 0.7, 0.3), rotation: [0, 0.3, 0, 0.954], material: thin([1, 0.7, 0.6], { extensions: volume(thicknessFactor) }) }]),
    ])),
    'texture-transform': scene(4, [hidden, ...grid([
      [{ offset: [0, 0] }, { offset: [0.5, 0.25] }, { rotation: Math.PI / 6 }, { scale: [2, 2] }].map((values) => ({ mesh: quad(), material: unlit([1, 1, 1], { pbr: { baseColorTexture: transform(values) } }) })),
      [{ rotation: Math.PI / 2 }, { rotation: 0.4, scale: [2, 1], offset: [0.3, 0.2] }].map((values) => ({ mesh: quad(), material: unlit([1, 1, 1], { pbr: { baseColorTexture: transform(values) } }) }))
        .concat([4, 5].map((index) => ({ mesh: quad(), material: unlit([1, 1, 1], { pbr: { baseColorTexture: { ...transform({ scale: [2, 2], offset: [-0.5, -0.5] }), index } } }) }))),
      [{ mesh: withSecond(quad(), (u, v) => [v, u]), material: unlit([1, 1, 1], { pbr: { baseColorTexture: { index: 1, texCoord: 1 } } }) },
        { mesh: withSecond(quad(), (u, v) => [v, u]), material: unlit([1, 1, 1], { pbr: { baseColorTexture: transform({ texCoord: 1, scale: [2, 2] }) } }) },
        { mesh: quad(), material: thin([1, 1, 1], { pbr: { baseColorTexture: transform({ rotation: -Math.PI / 6 }) } }) },
        { mesh: quad(), material: matt([0, 0, 0], { emissiveFactor: [1, 1, 1], emissiveTexture: transform({ scale: [-1, 1] }) }) }],
    ])]),
    'alpha-modes': scene(4, grid([
      [{}, { alphaMode: 'MASK' }, { alphaMode: 'MASK', alphaCutoff: 0.2 }, { alphaMode: 'BLEND' }].map((mode) => ({ mesh: quad(), material: matt([0.9, 0.3, 0.2], { ...mode, pbr: { baseColorTexture: { index: 2 } } }) })),
      [{}, { alphaMode: 'MASK' }, { alphaMode: 'MASK', alphaCutoff: 0.2 }, { alphaMode: 'BLEND' }].map((mode) => ({ mesh: quad(), material: thin([0.2, 0.5, 0.9], { ...mode, pbr: { baseColorTexture: { index: 2 } } }) })),
      [{}, { alphaMode: 'MASK' }, { alphaMode: 'MASK', alphaCutoff: 0.2 }, { alphaMode: 'BLEND' }].map((mode) => ({ mesh: box(0.8, 0.8, 0.3), material: solid([0.4, 0.9, 0.5], { ...mode, pbr: { baseColorTexture: { index: 2 } } }) })),
    ]), { args: ['--samples', '4'] }),
    'vertex-colors': (() => {
      const rainbow = (mesh) => ({ ...mesh, colors: Array.from({ length: mesh.positions.length / 3 }, (_, i) => [0, 1, 2].map((k) => 0.5 + 1.2 * mesh.positions[3 * i + k]).map((part) => Math.min(Math.max(part, 0), 1)).concat(0.5)).flat() });
      return scene(3, grid([
        [{ mesh: rainbow(quad()), material: matt([1, 1, 1]) }, { mesh: rainbow(quad()), material: thin() }, { mesh: rainbow(quad()), material: matt([1, 1, 1], { alphaMode: 'BLEND' }) }],
        [{ mesh: rainbow(globe), material: matt([1, 1, 1]) }, { mesh: rainbow(globe), material: solid() }, { mesh: rainbow(globe), material: unlit([1, 1, 0.5]) }],
      ]));
    })(),
    'negative-scale': scene(4, grid([
      [[1, 1, 1], [-1, 1, 1], [1, -1, 1], [-1, -1, -1]].map((scale) => ({ mesh: quad(), scale, material: matt([0.8, 0.8, 0.8], { normalTexture: { index: 3 }, pbr: { baseColorTexture: { index: 1 }, roughnessFactor: 0.4 } }) })),
      [[1, 1, 1], [-1, 1, 1], [1, -1, 1], [-1, -1, -1]].map((scale) => ({ mesh: globe, scale, material: solid([0.8, 1, 0.8], { normalTexture: { index: 3, scale: 0.3 } }) })),
    ]), { lit: true }),
    unlit: scene(3, grid([
      [{ mesh: quad(), material: unlit([0.9, 0.5, 0.1]) }, { mesh: quad(), material: matt([0.9, 0.5, 0.1]) }, { mesh: quad(), material: unlit([1, 1, 1], { pbr: { baseColorTexture: { index: 1 } } }) }],
      [{ mesh: globe, material: unlit([0.1, 0.5, 0.9]) }, { mesh: globe, material: matt([0.1, 0.5, 0.9]) }, { mesh: colored(globe, 0.2, 0.9, 0.3, 1), material: unlit([1, 1, 1]) }],
    ]), { lit: true, args: ['--exposure', '-1'] }),
    specular: scene(4, grid([
      [0, 0.33, 0.67, 1].map((factor) => ({ mesh: globe, material: matt([0.1, 0.1, 0.12], { extensions: specular(factor), pbr: { roughnessFactor: 0.2 } }) })),
      [[1, 0.2, 0.2], [0.2, 1, 0.2], [4, 4, 4], [10, 5, 1]].map((color) => ({ mesh: globe, material: matt([0.1, 0.1, 0.12], { extensions: specular(1, color), pbr: { roughnessFactor: 0.2 } }) })),
      [[0, [1, 1, 1]], [0.5, [1, 1, 1]], [1, [1, 1, 1]], [1, [10, 2, 2]]].map(([factor, color]) => ({ mesh: globe, material: solid([1, 1, 1], { extensions: specular(factor, color) }) })),
    ]), { lit: true }),
    iridescence: scene(4, grid([
      [100, 250, 400, 550].map((thickness) => ({ mesh: globe, material: matt([0.02, 0.02, 0.02], { extensions: film(thickness), pbr: { roughnessFactor: 0.1 } }) })),
      [100, 250, 400, 550].map((thickness) => ({ mesh: globe, material: matt([0.9, 0.8, 0.6], { extensions: film(thickness, 1.8), pbr: { metallicFactor: 1, roughnessFactor: 0.1 } }) })),
      [100, 250, 400, 550].map((thickness) => ({ mesh: globe, material: thin([1, 1, 1], { extensions: film(thickness, 1.33) }) })),
    ])),
  };
}
