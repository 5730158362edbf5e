import type { CatalogueData, Port, Problem, Role, StudyResult } from '../contract';

/** What the server refused, in its words. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    readonly problem: Problem,
  ) {
    super(problem.detail);
  }
}

async function request<T>(method: string, path: string, body?: object): Promise<T> {
  const response = await fetch(`/api/v1/${path}`, {
    method,
    ...(body && { body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' } }),
  });
  const isJson = response.headers.get('Content-Type')?.startsWith('application/json') ?? false;
  const answer: unknown = isJson ? await response.json() : undefined;
  if (!response.ok)
    throw new Refused(response.status, (answer as Problem) ?? { code: 'unknown', detail: response.statusText });
  return answer as T;
}

/** The server's answers to single questions; each throws `Refused` or, without a connection, `TypeError`. */
export const api = {
  catalogue: () => request<CatalogueData>('GET', 'catalogue'),
  ports: () => request<Port[]>('GET', 'ports'),
  signIn: (token: string) => request<{ role: Role }>('POST', 'session', { token }),
  signOut: () => request<void>('DELETE', 'session'),
  connect: (endpoint: string) => request<unknown>('POST', 'vehicle-links', { endpoint }),
  disconnect: (link: number) => request<void>('DELETE', `vehicle-links/${link}`),
  convert: (on: boolean) => request<void>('PUT', 'conversion', { on }),
  startStudy: (samples: number, limit_ms: number) => request<void>('POST', 'latency-study', { samples, limit_ms }),
  stopStudy: () => request<void>('DELETE', 'latency-study'),
  studyResult: () => request<StudyResult>('GET', 'latency-study/result'),
};

/** Where the browser finds the last study in a format. */
export function studyAddress(format: 'json' | 'csv' | 'html'): string {
  return `/api/v1/latency-study/result?format=${format}`;
}
