// Vertices of a mesh as its bones and morph targets place them: as three.js's shaders do, here by the CPU.
import { Matrix4 } from 'three';
import { numbersOf } from './numbers.js';

const bone = new Matrix4(), sum = new Matrix4();

/** Adds morph targets to numbers, 3 a vertex. */
function morph(numbers, targets, mesh) {
  const { morphTargetInfluences, geometry } = mesh;
  if (!numbers || !targets || !morphTargetInfluences) return numbers;
  const morphed = numbers.slice();
  targets.forEach((target, i) => {
    const influence = morphTargetInfluences[i] ?? 0;
    const moved = influence !== 0 && numbersOf(target, 3);
    for (let k = 0; moved && k < moved.length; ++k) morphed[k] += influence * (geometry.morphTargetsRelative ? moved[k] : moved[k] - numbers[k]);
  });
  return morphed;
}

/** The matrix of a vertex: the mean of its bones', by weight. */
function placeOf(mesh, vertex) {
  const { skinIndex, skinWeight } = mesh.geometry.attributes;
  sum.elements.fill(0);
  for (let i = 0; i < 4; ++i) {
    const weight = skinWeight.getComponent(vertex, i);
    if (weight === 0) continue;
    bone.fromArray(mesh.skeleton.boneMatrices, 16 * skinIndex.getComponent(vertex, i));
    for (let k = 0; k < 16; ++k) sum.elements[k] += weight * bone.elements[k];
  }
  return sum.multiply(mesh.bindMatrix).premultiply(mesh.bindMatrixInverse).elements;
}

function skin(mesh, positions, normals) {
  const skinned = { positions: new Float32Array(positions.length), normals: normals && new Float32Array(normals.length) };
  for (let vertex = 0; 3 * vertex < positions.length; ++vertex) {
    const m = placeOf(mesh, vertex), at = 3 * vertex;
    for (const [from, to, w] of [[positions, skinned.positions, 1], [normals, skinned.normals, 0]]) {
      for (let row = 0; from && row < 3; ++row) to[at + row] = m[row] * from[at] + m[4 + row] * from[at + 1] + m[8 + row] * from[at + 2] + w * m[12 + row];
    }
  }
  return skinned;
}

/** Positions and normals, 3 a vertex; null of a mesh that has neither bones nor morph targets. */
export function poseOf(mesh) {
  const { attributes, morphAttributes } = mesh.geometry;
  const hasMorphs = mesh.morphTargetInfluences?.length > 0 && morphAttributes.position;
  if (!mesh.isSkinnedMesh && !hasMorphs) return null;
  const positions = morph(numbersOf(attributes.position, 3), morphAttributes.position, mesh);
  const normals = morph(numbersOf(attributes.normal, 3), morphAttributes.normal, mesh);
  return mesh.isSkinnedMesh ? skin(mesh, positions, normals) : { positions, normals };
}

/** What a pose depends on, kept to be compared. */
export function poseKey(mesh) {
  if (mesh.isSkinnedMesh) mesh.skeleton.update();
  return { bones: mesh.isSkinnedMesh ? mesh.skeleton.boneMatrices.slice() : null, influences: mesh.morphTargetInfluences?.slice() ?? [] };
}

/** Has it changed? Then the key is that of the present pose. */
export function hasPoseChanged(mesh, key) {
  if (mesh.isSkinnedMesh) mesh.skeleton.update();
  const influences = mesh.morphTargetInfluences ?? [];
  const isSame = (a, b) => {
    for (let i = 0; i < a.length; ++i) if (a[i] !== b[i]) return false;
    return true;
  };
  if (isSame(influences, key.influences) && (!key.bones || isSame(mesh.skeleton.boneMatrices, key.bones))) return false;
  key.influences = influences.slice();
  key.bones?.set(mesh.skeleton.boneMatrices);
  return true;
}
