import type { Locator, Page } from '@playwright/test';

const COLUMNS = [
  'Variable',
  'Forced to',
  'Before force',
  'After program',
  'After force',
  'Current',
  'By',
  'Since scan',
];

/** The panel of all forces. */
export class Forces {
  constructor(private readonly page: Page) {}

  row(path: string): Locator {
    return this.page.getByRole('grid', { name: 'Forces' }).locator(`[data-force="${path}"]`);
  }

  cell(path: string, column: string): Locator {
    return this.row(path).getByRole('gridcell').nth(COLUMNS.indexOf(column));
  }

  async release(path: string): Promise<void> {
    await this.row(path).click();
    await this.row(path)
      .getByRole('button', { name: `Release force of ${path}`, exact: true })
      .click();
  }
}
