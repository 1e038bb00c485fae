import facetmill from './index.cjs';

export const { FacetmillError, diff, executable, info, pipe, run, stages } = facetmill;
export default facetmill;
