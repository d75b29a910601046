// The types of the bundle are those of the package.
declare module "three/build/three.module.js" {
  export * from "three";
}
