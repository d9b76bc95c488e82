/** What an error says, for whoever shows it. */
export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
