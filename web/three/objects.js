// The meshes of a scene that the core draws, or that glass sees by it.
import { Color, Matrix4, MeshBasicMaterial } from 'three';
import { isGlass, materialWords, writeMaterial } from './materials.js';

const objectWords = 14; // of vtThreeObject
const matrix = new Matrix4(), own = new Matrix4(), tint = new Color();

/** In place of glass while three.js draws what is not: nothing is seen of it, but its shadow stays. */
const ghosts = new Map();
function ghostOf({ side, shadowSide }, castsShadow) {
  const key = `${side} ${shadowSide} ${castsShadow}`;
  if (!ghosts.has(key)) ghosts.set(key, new MeshBasicMaterial({ side, shadowSide, visible: castsShadow, colorWrite: false, depthWrite: false, depthTest: false }));
  return ghosts.get(key);
}

/** Of indices or vertices: of all, or a group, as far as they are drawn. */
function rangeOf({ drawRange }, group) {
  const start = Math.max(group?.start ?? 0, drawRange.start);
  const end = Math.min(group ? group.start + group.count : Infinity, drawRange.start + drawRange.count);
  return { start, count: Math.max(end - start, 0) };
}

export class Objects {
  #parts = []; // {mesh, material, isOpaque, entry} of this frame
  #hidden = []; // [mesh, its material]
  #rows = new Map(); // material -> its place among those of the frame
  #rowCount = 0;
  #objectCount = 0;
  isWaiting = false; // for geometry that is not built yet

  /** Of meshes, or groups of them. */
  get count() {
    return this.#parts.length;
  }

  get hasGlass() {
    return this.#parts.some(({ isOpaque }) => !isOpaque);
  }

  /**
   * Looks which meshes there are. Those whose geometry is not built yet are left to three.js.
   * @param {number} until as Geometries.use
   */
  collect(scene, camera, geometries, { until, isExact, note }) {
    this.#parts.length = 0;
    this.isWaiting = false;
    scene.traverseVisible((mesh) => {
      if (!mesh.isMesh || mesh.userData.glass === false || !mesh.layers.test(camera.layers)) return;
      const isArray = Array.isArray(mesh.material), groups = isArray ? mesh.geometry.groups : [null];
      let parts = []; // of the mesh: all of them or none, as they may share a material
      for (const group of groups) {
        const material = isArray ? mesh.material[group.materialIndex] : mesh.material;
        const isOpaque = !isGlass(material);
        if (!material || (isOpaque && !isExact(mesh))) continue;
        if (mesh.isBatchedMesh || !mesh.geometry.attributes.position) {
          note(`'${mesh.name || mesh.uuid}' is ${mesh.isBatchedMesh ? 'a BatchedMesh' : 'without positions'}; three.js draws it`);
          continue;
        }
        const entry = geometries.use(mesh, rangeOf(mesh.geometry, group), material.flatShading === true, until);
        if (entry.problem) note(`${entry.problem}; three.js draws it`);
        else if (entry.isReady) parts?.push({ mesh, material, isOpaque, entry });
        else parts = null;
      }
      if (parts) this.#parts.push(...parts);
      else this.isWaiting = true;
    });
  }

  get hasRoughGlass() {
    return this.#parts.some(({ isOpaque, material }) => !isOpaque && material.roughness > 0);
  }

  /** Leaves to three.js what is not glass, until `show`. */
  hide(castsShadows) {
    for (const { mesh, isOpaque } of this.#parts) {
      if (isOpaque || this.#hidden.some(([one]) => one === mesh)) continue;
      this.#hidden.push([mesh, mesh.material]);
    }
    for (const [mesh, material] of this.#hidden) {
      const own = this.#parts.filter((part) => part.mesh === mesh && !part.isOpaque).map((part) => part.material);
      const replace = (one) => (own.includes(one) ? ghostOf(one, castsShadows && mesh.castShadow) : one);
      mesh.material = Array.isArray(material) ? material.map(replace) : replace(material);
    }
  }

  show() {
    for (const [mesh, material] of this.#hidden) mesh.material = material;
    this.#hidden.length = 0;
  }

  #rowOf({ material, isOpaque }, tint, more, core) {
    const known = tint ? undefined : this.#rows.get(material);
    if (known !== undefined) return known;
    const row = this.#rowCount++;
    if (!tint) this.#rows.set(material, row);
    const { floats, words } = core.materials.reserve(0);
    writeMaterial(material, isOpaque, { ...more, tint }, floats, words, materialWords * row);
    return row;
  }

  /** Writes them into the core's memory. @param {Matrix4} toCore from three.js's world to the core's @param more as of writeMaterial @returns {number} how many there are */
  write(core, toCore, more) {
    const countOf = ({ mesh }) => (mesh.isInstancedMesh ? mesh.count : 1);
    const most = this.#parts.reduce((sum, part) => sum + countOf(part), 0);
    this.#rows.clear();
    this.#rowCount = this.#objectCount = 0;
    core.materials.reserve(materialWords * most);
    const { floats, words } = core.objects.reserve(objectWords * most);
    for (const part of this.#parts) {
      const { mesh, entry } = part;
      for (let k = 0; k < countOf(part); ++k) {
        matrix.multiplyMatrices(toCore, mesh.matrixWorld);
        if (mesh.isInstancedMesh) matrix.multiply((mesh.getMatrixAt(k, own), own));
        if (!(Math.abs(matrix.determinant()) > 1e-30)) continue; // nothing is seen of it
        if (mesh.isInstancedMesh && mesh.instanceColor) mesh.getColorAt(k, tint);
        const e = matrix.elements, at = objectWords * this.#objectCount++;
        words[at] = entry.number;
        words[at + 1] = this.#rowOf(part, mesh.isInstancedMesh && mesh.instanceColor ? tint : null, more, core);
        for (let row = 0; row < 3; ++row) for (let column = 0; column < 4; ++column) floats[at + 2 + 4 * row + column] = e[4 * column + row];
      }
    }
    return this.#objectCount;
  }

  /** Places in the core what was written. */
  place(core) {
    core.attempt('Place', core.objects.place, this.#objectCount, core.materials.place, this.#rowCount);
  }
}
