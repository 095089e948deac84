// The course: lit facet by facet, with a line every metre so that one sees it pass.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshStandardMaterial } from 'three';
import type { TerrainMesh } from '../engine/messages';
import type { Palette } from './theme';

const k_grid_vertex = /* glsl */ `
#include <fog_vertex>
vGroundPosition = (modelMatrix * vec4(transformed, 1.0)).xyz;`;

const k_grid_fragment = /* glsl */ `
#include <color_fragment>
{
  vec3 facet = normalize(cross(dFdx(vGroundPosition), dFdy(vGroundPosition)));
  vec2 at = vGroundPosition.xz, width = fwidth(at);
  vec2 off = abs(fract(at - 0.5) - 0.5) / max(width, vec2(1e-4));
  float line = 1.0 - min(min(off.x, off.y), 1.0);
  float level = smoothstep(0.5, 0.9, abs(facet.y));
  float near = 1.0 - smoothstep(0.12, 0.5, max(width.x, width.y));
  diffuseColor.rgb = mix(diffuseColor.rgb, uLine, line * level * near * 0.7);
}`;

export class GroundView {
  readonly mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  readonly #line = { value: new Color() };

  constructor() {
    const material = new MeshStandardMaterial({ roughness: 0.95, flatShading: true, side: DoubleSide }); // courses show their sides from both
    material.onBeforeCompile = (shader) => {
      shader.uniforms['uLine'] = this.#line;
      shader.vertexShader = shader.vertexShader
        .replace('#include <common>', '#include <common>\nvarying vec3 vGroundPosition;')
        .replace('#include <fog_vertex>', k_grid_vertex);
      shader.fragmentShader = shader.fragmentShader
        .replace('#include <common>', '#include <common>\nvarying vec3 vGroundPosition;\nuniform vec3 uLine;')
        .replace('#include <color_fragment>', k_grid_fragment);
    };
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
  }

  show(terrain: TerrainMesh): void {
    this.mesh.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(terrain.positions, 3));
    geometry.setIndex(new BufferAttribute(terrain.triangles, 1));
    this.mesh.geometry = geometry;
  }

  paint(palette: Palette): void {
    this.mesh.material.color.set(palette.ground);
    this.#line.value.set(palette.line);
  }
}
