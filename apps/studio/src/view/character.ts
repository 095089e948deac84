// The skinned character. Bones are bare matrices that the engine's frame is read into; three.js computes no pose.
import {
  Bone, BufferAttribute, BufferGeometry, KeepStencilOp, Matrix4, MeshStandardMaterial, NotEqualStencilFunc,
  ReplaceStencilOp, Skeleton, SkinnedMesh,
} from 'three';
import type { CharacterMesh } from '../engine/messages';
import type { Palette } from './theme';

const k_matrix_floats = 16;

export class CharacterView {
  readonly mesh: SkinnedMesh<BufferGeometry, MeshStandardMaterial>;
  readonly #bones: Bone[];

  constructor(mesh: CharacterMesh) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(mesh.normals, 3));
    geometry.setAttribute('skinIndex', new BufferAttribute(mesh.joints, 4));
    geometry.setAttribute('skinWeight', new BufferAttribute(mesh.weights, 4));
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    const inverses: Matrix4[] = [];
    for (let at = 0; at < mesh.inverseBind.length; at += k_matrix_floats)
      inverses.push(new Matrix4().fromArray(mesh.inverseBind, at));
    this.#bones = inverses.map(() => new Bone());
    const stencil = { stencilWrite: true, stencilRef: 1, stencilZPass: ReplaceStencilOp };
    this.mesh = new SkinnedMesh(geometry, new MeshStandardMaterial({ roughness: 0.62, ...stencil }));
    this.mesh.bind(new Skeleton(this.#bones, inverses), new Matrix4());
    this.mesh.frustumCulled = false; // it is where its joints are, not where its node is
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
  }

  pose(frame: Float32Array, firstJoint: number): void {
    this.#bones.forEach((bone, joint) => bone.matrixWorld.fromArray(frame, firstJoint + joint * k_matrix_floats));
  }

  /** One can see through it, and it stays around those who do not fade: the stencil has where they are. */
  fade(): void {
    this.mesh.material.transparent = true;
    this.mesh.material.stencilFunc = NotEqualStencilFunc;
    this.mesh.material.stencilZPass = KeepStencilOp;
    this.mesh.material.depthWrite = false;
    this.mesh.castShadow = false;
    this.mesh.receiveShadow = false;
  }

  paint(palette: Palette): void {
    this.mesh.material.color.set(palette.body);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.mesh.skeleton.dispose();
  }
}
