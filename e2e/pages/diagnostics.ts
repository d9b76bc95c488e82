import type { Locator, Page } from '@playwright/test';
import { toFront } from './tabs';

/** Subrange violations that the embedded checks found while the program ran. */
export class Diagnostics {
  constructor(private readonly page: Page) {}

  get tab(): Locator {
    return this.page.getByRole('tab', { name: /^Diagnostics/ });
  }

  get list(): Locator {
    return this.page.getByRole('list', { name: 'Runtime diagnostics' });
  }

  entry(text: string): Locator {
    return this.list.getByRole('button').filter({ hasText: text });
  }

  get clearButton(): Locator {
    return this.page.getByRole('button', { name: 'Clear', exact: true });
  }

  async show(): Promise<void> {
    await toFront(this.tab);
  }
}
