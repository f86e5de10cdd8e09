// Scenes of several objects of glass. The thesis does not describe its own: these are of their kind.
import { all, layered, side, studio, traced } from './subject.mjs';

/** Objects from the nearest to the farthest. */
export const scenes = {
  cube: { objects: ['sphere:at=-0.5,0,0.6,scale=0.8', 'cube:at=0.45,0,-1.4,rotate=0,30,0'], camera: '0.7,0.6,5.4', target: '0,0,-0.4' },
  knot: { objects: ['cube:at=0,0,0.6', 'knot:at=0,0,-2'], camera: '1.1,1,4.6', target: '0,0.05,-0.6' },
  torus: { objects: ['torus:at=0,0,0.6,rotate=80,0,0,scale=0.9', 'sphere:at=0.4,0,-2'], camera: '0.6,0.8,5.6', target: '0,0,-0.6' },
  three: { objects: ['knot:at=-0.4,0,1,scale=0.8', 'torus:at=0.3,0,-1,rotate=70,0,20', 'sphere:at=0,0.2,-3'], camera: '0.9,1.2,5.4', target: '0,0,-0.8' },
};
const colours = ['0.8,0.3,0.1', '0.1,0.4,0.7', '0.3,0.6,0.2'];

/** What there is to draw of a scene; each is drawn when asked for. */
export function partsOfScene(id, { objects, camera, target }) {
  const named = (list) => list.flatMap((object) => ['--object', object]);
  const words = (list, technique) => all([...named(list), `--camera=${camera}`, `--target=${target}`, '--fov=36'], technique);
  const nearest = words(objects.slice(0, 1), layered());
  const ours = (multi) => words(objects, [...layered({ events: 5 * objects.length }), '--multi', multi]); // each object's five
  const colour = (name, drawing) => studio.drawDirections(name, drawing).then((directions) => studio.colour(`${name}-directions`, directions));
  return {
    design: () => studio.draw(`${id}-design`, words(objects.map((object, i) => `${object},colour=${colours[i]}`), ['-t', 'exact'])),
    nearest: () => studio.draw(`${id}-nearest`, nearest),
    nearestDirections: () => colour(`${id}-nearest`, nearest),
    ordered: () => studio.draw(`${id}-ordered`, ours('ordered')),
    orderedDirections: () => colour(`${id}-ordered`, ours('ordered')),
    any: () => studio.draw(`${id}-any`, ours('any')),
    coarse: () => studio.draw(`${id}-coarse`, [...ours('ordered'), '--layer-size', String(Math.round(side / 4))]),
    traced: () => studio.draw(`${id}-traced`, words(objects, traced())),
    /** How far from ray tracing of as many events the directions of `ordered` are. */
    errors: async () => {
      const truth = studio.drawDirections(`${id}-traced`, words(objects, traced(5 * objects.length)));
      return studio.compareDirections(`${id}-errors`, await studio.drawDirections(`${id}-ordered`, ours('ordered')), await truth);
    },
  };
}
