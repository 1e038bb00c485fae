import type { Diff, Info, Report } from './reports';

export type { Diff, Info, Report };

/** A stage that begins (done is false) or has ended. */
export interface Progress { name: string; number?: number; of?: number; done: boolean; faces?: number }

export interface Options {
  /** Further options of the command line, such as ['--strict']. */
  options?: string[];
  /** false: a run whose checks fail returns its report. */
  check?: boolean;
  cwd?: string;
  onProgress?: (progress: Progress) => void;
  signal?: AbortSignal;
}

export interface RunOptions extends Options {
  params?: Record<string, string | number | boolean | string[]>;
  outputDir?: string;
}

/** A run that did not pass. */
export class FacetmillError extends Error {
  /** The id of the message: E-FILE. */
  id: string;
  /** FILE:LINE:COLUMN, or empty. */
  place: string;
  hint: string;
  exitCode: number;
  report?: Report;
}

/** The path of the program: $FACETMILL, or that of the package for this system. */
export function executable(): string;
/** Runs a pipeline: a YAML file, the name of a built-in pipeline, or an object with the keys of such a file. */
export function run(pipeline: string | object, options?: RunOptions): Promise<Report>;
/** Runs stages, as after `facetmill pipe`. A list is taken word by word, which paths with blanks need. */
export function pipe(stages: string | string[], options?: Options): Promise<Report>;
/** The properties of a mesh file. */
export function info(file: string, options?: string[]): Promise<Info>;
/** Compares two mesh files. */
export function diff(a: string, b: string, options?: string[]): Promise<Diff>;
/** All stages with their options. */
export function stages(): Promise<Array<Record<string, unknown>>>;
